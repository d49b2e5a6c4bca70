// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "algorithms/partition/exact_line.h"

namespace gnomon {

namespace {

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// The axis along which the line of an edge runs, for comparing points on it.
int axis_along(const PointTable& points, std::uint32_t a, std::uint32_t b) {
  for (int axis = 0; axis < 2; ++axis) {
    if (points.compare(a, b, axis) != 0) return axis;
  }
  return 2;
}

}  // namespace

void FaceLoops::add(MeshFace like, std::span<const std::uint32_t> loop) {
  like.first = static_cast<std::uint32_t>(corners.size());
  like.count = static_cast<std::uint32_t>(loop.size());
  faces.push_back(like);
  corners.insert(corners.end(), loop.begin(), loop.end());
}

EdgeList::EdgeList(const FaceLoops& loops, const std::function<bool(std::size_t)>& takes) {
  for (std::size_t f = 0; f < loops.faces.size(); ++f) {
    if (!takes(f)) continue;
    const auto loop = loops.loop(loops.faces[f]);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      edges_.push_back(edge_key(loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

std::size_t EdgeList::find(std::uint32_t a, std::uint32_t b) const {
  const std::uint64_t key = edge_key(a, b);
  const auto at = std::lower_bound(edges_.begin(), edges_.end(), key);
  if (at == edges_.end() || *at != key) return kNone;
  return static_cast<std::size_t>(at - edges_.begin());
}

FaceLoops insert_vertices(const FaceLoops& loops, const EdgeList& edges,
                          const std::vector<std::vector<std::uint32_t>>& inserted) {
  FaceLoops result;
  result.faces.reserve(loops.faces.size());
  std::vector<std::uint32_t> longer;
  for (const MeshFace& face : loops.faces) {
    const auto loop = loops.loop(face);
    longer.clear();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      longer.push_back(a);
      const std::size_t edge = edges.find(a, b);
      if (edge == EdgeList::kNone) continue;
      const std::vector<std::uint32_t>& between = inserted[edge];
      if (a < b) {
        longer.insert(longer.end(), between.begin(), between.end());
      } else {
        longer.insert(longer.end(), between.rbegin(), between.rend());
      }
    }
    result.add(face, longer);
  }
  return result;
}

FaceLoops fit_edges(const FaceLoops& loops, const PointTable& points) {
  const EdgeList edges(loops, [](std::size_t) { return true; });
  std::vector<ExactLine> lines(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t edge) {
    const ExactPoint &from = points.exact(edges.from(edge)), &to = points.exact(edges.to(edge));
    lines[edge] = line_through(from.numerator, from.denominator, to.numerator, to.denominator);
  });
  const std::vector<std::vector<std::uint32_t>> on_line = group_equal_lines(lines);
  std::vector<std::vector<std::uint32_t>> inserted(edges.size());
  tbb::parallel_for(std::size_t{0}, on_line.size(), [&](std::size_t line) {
    const std::vector<std::uint32_t>& members = on_line[line];
    if (members.size() == 1) return;
    const int axis = axis_along(points, edges.from(members[0]), edges.to(members[0]));
    std::vector<std::uint32_t> ends;
    for (const std::uint32_t edge : members) {
      ends.push_back(edges.from(edge));
      ends.push_back(edges.to(edge));
    }
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return a != b && points.compare(a, b, axis) < 0;
    };
    std::sort(ends.begin(), ends.end(), before);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const std::uint32_t edge : members) {
      auto low = std::lower_bound(ends.begin(), ends.end(), edges.from(edge), before);
      auto high = std::lower_bound(ends.begin(), ends.end(), edges.to(edge), before);
      if (low < high) {
        inserted[edge].assign(low + 1, high);
      } else {
        inserted[edge].assign(high + 1, low);
        std::reverse(inserted[edge].begin(), inserted[edge].end());
      }
    }
  });
  return insert_vertices(loops, edges, inserted);
}

}  // namespace gnomon
