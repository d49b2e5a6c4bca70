// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/mesh_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace gnomon::oracle {

namespace {

/// A line: its direction, the first component that is not 0 made 1, and the point on it where that
/// coordinate is 0. Equal lines have equal numbers.
using Line = std::array<mpq_class, 6>;

struct EdgeOnLine {
  mpq_class from, to;  // the coordinate along the line, from < to
  std::size_t face = 0, edge = 0;
  bool forward = true;  // the face has it from `from` to `to`
};

struct CornerOnLine {
  mpq_class at;
  std::size_t face = 0, corner = 0;
};

struct OnLine {
  std::vector<EdgeOnLine> edges;
  std::vector<CornerOnLine> corners;
};

struct Placed {
  Line line;
  std::size_t axis = 0;
};

Placed line_through(const RationalPoint& a, const RationalPoint& b) {
  Placed placed;
  std::array<mpq_class, 3> step;
  for (std::size_t k = 0; k < 3; ++k) step[k] = b[k] - a[k];
  while (placed.axis < 2 && sgn(step[placed.axis]) == 0) ++placed.axis;
  for (std::size_t k = 0; k < 3; ++k) {
    placed.line[k] = step[k] / step[placed.axis];
    placed.line[3 + k] = a[k] - a[placed.axis] * placed.line[k];
  }
  return placed;
}

double interpolated(const MeshFaceClaim& face, const EdgeOnLine& edge, const mpq_class& at) {
  const double t = mpq_class((at - edge.from) / (edge.to - edge.from)).get_d();
  const std::size_t next = edge.edge + 1 == face.loop.size() ? 0 : edge.edge + 1;
  const double first = face.shades[edge.forward ? edge.edge : next];
  const double last = face.shades[edge.forward ? next : edge.edge];
  return first + t * (last - first);
}

double jump_at(std::span<const MeshFaceClaim> faces, const EdgeOnLine& edge,
               const CornerOnLine& corner) {
  const MeshFaceClaim &face = faces[edge.face], &other = faces[corner.face];
  if (face.polygon != other.polygon || face.side != other.side || face.dark || other.dark ||
      face.shades.size() != face.loop.size() || other.shades.size() != other.loop.size()) {
    return 0;
  }
  return std::fabs(other.shades[corner.corner] - interpolated(face, edge, corner.at));
}

}  // namespace

MeshReport check_mesh(std::span<const MeshFaceClaim> faces, std::size_t most) {
  MeshReport report;
  report.faces = faces.size();
  std::map<Line, OnLine> lines;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::vector<RationalPoint>& loop = faces[f].loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t next = i + 1 == loop.size() ? 0 : i + 1;
      if (loop[i] == loop[next]) continue;
      ++report.edges;
      const Placed placed = line_through(loop[i], loop[next]);
      OnLine& on_line = lines[placed.line];
      const mpq_class &a = loop[i][placed.axis], &b = loop[next][placed.axis];
      const bool forward = a < b;
      on_line.edges.push_back({forward ? a : b, forward ? b : a, f, i, forward});
      on_line.corners.push_back({a, f, i});
      on_line.corners.push_back({b, f, next});
    }
  }
  for (auto& [line, on_line] : lines) {
    std::ranges::sort(on_line.corners, [](const CornerOnLine& a, const CornerOnLine& b) {
      return a.at != b.at ? a.at < b.at : a.face < b.face;
    });
    for (const EdgeOnLine& edge : on_line.edges) {
      auto corner = std::ranges::upper_bound(on_line.corners, edge.from, {}, &CornerOnLine::at);
      while (corner != on_line.corners.end() && corner->at < edge.to) {
        // All corners at this place: the face that jumps most is named.
        TVertex found;
        found.face = edge.face;
        found.edge = edge.edge;
        found.neighbour = corner->face;
        found.point = faces[corner->face].loop[corner->corner];
        const mpq_class& at = corner->at;
        for (; corner != on_line.corners.end() && corner->at == at; ++corner) {
          const double jump = jump_at(faces, edge, *corner);
          if (jump <= found.jump) continue;
          found.jump = jump;
          found.neighbour = corner->face;
        }
        ++report.t_vertices;
        report.largest_jump = std::max(report.largest_jump, found.jump);
        report.worst.push_back(std::move(found));
      }
    }
  }
  std::ranges::stable_sort(report.worst,
                           [](const TVertex& a, const TVertex& b) { return a.jump > b.jump; });
  if (report.worst.size() > most) report.worst.resize(most);
  return report;
}

}  // namespace gnomon::oracle
