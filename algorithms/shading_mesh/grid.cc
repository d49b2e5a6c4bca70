// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace gnomon {

namespace {

/// The first line behind a place, going up.
std::int64_t line_after(std::int64_t place) { return (place >> 1) + 1; }
/// Lines strictly between two places.
std::int64_t lines_between(std::int64_t low, std::int64_t high) {
  return std::max<std::int64_t>(0, ((high + 1) >> 1) - line_after(low));
}

bool is_set(const std::atomic<bool>* flag) {
  return flag != nullptr && flag->load(std::memory_order_relaxed);
}

/// Where the edge from a to b meets a line of the grid. Requires: they are on different sides.
ExactPoint meet(const ExactPoint& a, const ExactPoint& b, int axis, const mpq_class& line) {
  const auto k = static_cast<std::size_t>(axis);
  // The values of the two ends are of opposite signs; each end weighs as much as the other's value.
  const mpz_class weight_b = abs(a.numerator[k] * line.get_den() - line.get_num() * a.denominator);
  const mpz_class weight_a = abs(b.numerator[k] * line.get_den() - line.get_num() * b.denominator);
  ExactPoint result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.numerator[i] = weight_a * a.numerator[i] + weight_b * b.numerator[i];
  }
  result.denominator = weight_a * a.denominator + weight_b * b.denominator;
  make_primitive(result);
  return result;
}

ExactPoint on_plane(const MeshPlane& plane, const mpq_class& u, const mpq_class& v) {
  const auto i = static_cast<std::size_t>(plane.axes[0]);
  const auto j = static_cast<std::size_t>(plane.axes[1]);
  const auto k = static_cast<std::size_t>(plane.dropped());
  std::array<mpq_class, 3> point;
  point[i] = u;
  point[j] = v;
  point[k] = (plane.d - plane.n[i] * u - plane.n[j] * v) / plane.n[k];
  return exact_point(point);
}

/// A corner of a face that is being cut: a numbered vertex, or a new one where two lines meet.
struct CutCorner {
  static constexpr std::uint32_t kNew = 0x80000000u;  // the rest counts in FaceCut::made
  std::uint32_t vertex = 0;
  std::array<std::int64_t, 2> place{};  // along the axes of the chart
};
using CutLoop = std::vector<CutCorner>;

/// One face cut by its grid: its cells, and the vertices made for them.
struct FaceCut {
  std::vector<NewPoint> made;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> counts;  // of each cell; none: the face is not cut
};

class FaceCutter {
 public:
  FaceCutter(const PointTable& points, const GridLines& lines, const MeshPlane& plane)
      : points_(points), lines_(lines), plane_(plane) {}

  FaceCut cut(std::span<const std::uint32_t> loop) {
    CutLoop face;
    face.reserve(loop.size());
    for (const std::uint32_t vertex : loop) {
      face.push_back({vertex,
                      {lines_.place(points_, vertex, plane_.axes[0]),
                       lines_.place(points_, vertex, plane_.axes[1])}});
    }
    if (cuts(face, 0) + cuts(face, 1) == 0) return {};
    slice(face, 0, [&](CutLoop& strip) {
      insert_crossings(strip);
      slice(strip, 1, [&](const CutLoop& cell) { emit(cell); });
    });
    return std::move(result_);
  }

 private:
  static std::pair<std::int64_t, std::int64_t> range(const CutLoop& loop, std::size_t axis) {
    std::int64_t low = loop[0].place[axis], high = low;
    for (const CutCorner& corner : loop) {
      low = std::min(low, corner.place[axis]);
      high = std::max(high, corner.place[axis]);
    }
    return {low, high};
  }
  static std::int64_t cuts(const CutLoop& loop, std::size_t axis) {
    const auto [low, high] = range(loop, axis);
    return lines_between(low, high);
  }

  /// Hands out what is between the lines of one axis. Requires: the border has a vertex wherever a
  /// line crosses it.
  template <class Emit>
  static void slice(CutLoop loop, std::size_t axis, const Emit& emit) {
    const auto [low, high] = range(loop, axis);
    CutLoop below, above;
    for (std::int64_t line = line_after(low); 2 * line < high; ++line) {
      below.clear();
      above.clear();
      for (const CutCorner& corner : loop) {
        if (corner.place[axis] <= 2 * line) below.push_back(corner);
        if (corner.place[axis] >= 2 * line) above.push_back(corner);
      }
      emit(below);
      loop.swap(above);
    }
    emit(loop);
  }

  /// Puts the crossings of lines into the edges of a strip that lie along a line: those that cut
  /// the face, since edges of the face have theirs already.
  void insert_crossings(CutLoop& strip) {
    CutLoop longer;
    for (std::size_t i = 0; i < strip.size(); ++i) {
      const CutCorner& a = strip[i];
      const CutCorner& b = strip[(i + 1) % strip.size()];
      longer.push_back(a);
      if (a.place[0] != b.place[0] || (a.place[0] & 1) != 0) continue;
      if (a.place[1] < b.place[1]) {
        for (std::int64_t line = line_after(a.place[1]); 2 * line < b.place[1]; ++line) {
          longer.push_back(crossing(a.place[0] / 2, line));
        }
      } else {
        for (std::int64_t line = ((a.place[1] + 1) >> 1) - 1; 2 * line > b.place[1]; --line) {
          longer.push_back(crossing(a.place[0] / 2, line));
        }
      }
    }
    strip = std::move(longer);
  }

  CutCorner crossing(std::int64_t i, std::int64_t j) {
    const auto [at, is_new] =
        crossings_.emplace(std::pair(i, j), static_cast<std::uint32_t>(result_.made.size()));
    if (is_new) result_.made.push_back(new_point(on_plane(plane_, lines_.at(i), lines_.at(j))));
    return {at->second | CutCorner::kNew, {2 * i, 2 * j}};
  }

  void emit(const CutLoop& cell) {
    for (const CutCorner& corner : cell) result_.corners.push_back(corner.vertex);
    result_.counts.push_back(static_cast<std::uint32_t>(cell.size()));
  }

  const PointTable& points_;
  const GridLines& lines_;
  const MeshPlane& plane_;
  FaceCut result_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> crossings_;
};

/// Which grids cut an edge along which axes: a bit for each.
constexpr unsigned bit_of(std::size_t grid, int axis) {
  return 1u << (3 * grid + static_cast<unsigned>(axis));
}

/// The vertices of all grids asked for on one edge, in order, each once.
std::vector<NewPoint> points_on_edge(const PointTable& points, std::uint32_t from, std::uint32_t to,
                                     unsigned asked, std::span<const GridLines> grids) {
  std::vector<NewPoint> result;
  for (std::size_t grid = 0; grid < grids.size(); ++grid) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((asked & bit_of(grid, axis)) == 0) continue;
      const std::int64_t a = grids[grid].place(points, from, axis);
      const std::int64_t b = grids[grid].place(points, to, axis);
      const auto [low, high] = std::minmax(a, b);
      for (std::int64_t line = line_after(low); 2 * line < high; ++line) {
        result.push_back(
            new_point(meet(points.exact(from), points.exact(to), axis, grids[grid].at(line))));
      }
    }
  }
  if (result.size() < 2) return result;
  int along = 0;
  while (points.compare(from, to, along) == 0) ++along;
  const bool up = points.compare(from, to, along) < 0;
  const auto k = static_cast<std::size_t>(along);
  std::sort(result.begin(), result.end(), [&](const NewPoint& a, const NewPoint& b) {
    if (a.nearest[k] != b.nearest[k]) return (a.nearest[k] < b.nearest[k]) == up;
    const int order = compare(a.exact, b.exact, along);
    return up ? order < 0 : order > 0;
  });
  result.erase(std::unique(result.begin(), result.end(),
                           [](const NewPoint& a, const NewPoint& b) { return a.exact == b.exact; }),
               result.end());
  return result;
}

/// Cuts all faces: first their edges, each once, then each face through the vertices of its edges.
class GridCutter {
 public:
  GridCutter(const PreparedScene& scene, const FaceLoops& loops, const GridRequest& request,
             PointTable& points)
      : scene_(scene),
        loops_(loops),
        request_(request),
        points_(points),
        plane_numbers_(scene.geometry.planes.size(), kNone) {
    for (std::size_t f = 0; f < loops.faces.size(); ++f) {
      if (!has_grid(f)) continue;
      const PlaneId plane = scene.parts[loops.faces[f].part].plane;
      if (plane_numbers_[plane] != kNone) continue;
      plane_numbers_[plane] = static_cast<std::uint32_t>(planes_.size());
      planes_.push_back(mesh_plane(scene, plane));
    }
  }

  Expected<GridCut> cut() {
    if (auto done = check_count(); !done) return tl::unexpected(std::move(done.error()));
    const FaceLoops fitted = cut_edges();
    if (interrupted()) return stopped();
    std::vector<FaceCut> cuts(loops_.faces.size());
    tbb::parallel_for(std::size_t{0}, cuts.size(), [&](std::size_t f) {
      if (!has_grid(f) || interrupted()) return;
      const MeshFace& face = fitted.faces[f];
      FaceCutter cutter(points_, grid(f), plane_of(face));
      cuts[f] = cutter.cut(fitted.loop(face));
    });
    if (interrupted()) return stopped();
    return collect(fitted, cuts);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  bool interrupted() const { return is_set(request_.interrupted); }
  static tl::unexpected<Error> stopped() {
    return fail(ErrorCode::kInterrupted, "interrupted while gridding");
  }
  bool has_grid(std::size_t f) const { return request_.grid_of[f] != kNoGrid; }
  const GridLines& grid(std::size_t f) const { return request_.grids[request_.grid_of[f]]; }
  const MeshPlane& plane_of(const MeshFace& face) const {
    return planes_[plane_numbers_[scene_.parts[face.part].plane]];
  }

  /// Counts the cells of all faces, roughly from above, before any is made.
  Expected<void> check_count() const {
    std::uint64_t cells = loops_.faces.size();
    for (std::size_t f = 0; f < loops_.faces.size() && cells <= request_.max_faces; ++f) {
      if (!has_grid(f)) continue;
      std::array<std::uint64_t, 2> across{1, 1};
      for (std::size_t k = 0; k < 2; ++k) {
        const auto axis = static_cast<std::size_t>(plane_of(loops_.faces[f]).axes[k]);
        double low = INFINITY, high = -INFINITY;
        for (const std::uint32_t vertex : loops_.loop(loops_.faces[f])) {
          low = std::min(low, points_.nearest(vertex)[axis]);
          high = std::max(high, points_.nearest(vertex)[axis]);
        }
        const double step = grid(f).step();
        if (!(std::max(std::fabs(low), std::fabs(high)) < GridLines::kMostLines * step)) {
          return fail(ErrorCode::kLimit, "the grid's step is too small for coordinates this large",
                      "a larger step");
        }
        across[k] += static_cast<std::uint64_t>(
            std::min((high - low) / step, static_cast<double>(request_.max_faces)));
      }
      cells += across[0] * across[1] - 1;
    }
    if (cells <= request_.max_faces) return {};
    return fail(
        ErrorCode::kLimit,
        "the grid cuts the scene into more than " + std::to_string(request_.max_faces) + " faces",
        "a larger step");
  }

  /// By edge of the list: the grids and axes that cut it, as bit_of().
  std::vector<std::uint8_t> cuts_of(const EdgeList& edges) const {
    std::vector<std::uint8_t> asked(edges.size(), 0);
    for (std::size_t f = 0; f < loops_.faces.size(); ++f) {
      if (!has_grid(f)) continue;
      const auto [u, v] = plane_of(loops_.faces[f]).axes;
      const auto loop = loops_.loop(loops_.faces[f]);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint8_t own = request_.grid_of[f];
        asked[edges.find(loop[i], loop[(i + 1) % loop.size()])] |=
            static_cast<std::uint8_t>(bit_of(own, u) | bit_of(own, v));
      }
    }
    return asked;
  }

  /// The loops of all faces with the vertices of the grids in their edges; incomplete if
  /// interrupted.
  FaceLoops cut_edges() {
    const EdgeList edges(loops_, [&](std::size_t f) { return has_grid(f); });
    const std::vector<std::uint8_t> asked = cuts_of(edges);
    std::vector<std::vector<NewPoint>> made(edges.size());
    tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t edge) {
      if (interrupted()) return;
      made[edge] =
          points_on_edge(points_, edges.from(edge), edges.to(edge), asked[edge], request_.grids);
    });
    if (interrupted()) return {};
    std::vector<std::vector<std::uint32_t>> inserted(edges.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
      for (NewPoint& point : made[edge]) inserted[edge].push_back(points_.insert(std::move(point)));
    }
    made.clear();
    return insert_vertices(loops_, edges, inserted);
  }

  /// The cells of all faces in order, their new vertices numbered.
  GridCut collect(const FaceLoops& fitted, std::vector<FaceCut>& cuts) {
    GridCut result;
    std::vector<std::uint32_t> numbers, loop;
    for (std::size_t f = 0; f < cuts.size(); ++f) {
      const MeshFace& face = fitted.faces[f];
      if (cuts[f].counts.empty()) {
        result.loops.add(face, fitted.loop(face));
        result.origins.push_back(static_cast<std::uint32_t>(f));
        continue;
      }
      numbers.clear();
      for (NewPoint& point : cuts[f].made) numbers.push_back(points_.insert(std::move(point)));
      std::size_t at = 0;
      for (const std::uint32_t count : cuts[f].counts) {
        loop.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
          const std::uint32_t vertex = cuts[f].corners[at++];
          loop.push_back((vertex & CutCorner::kNew) != 0 ? numbers[vertex & ~CutCorner::kNew]
                                                         : vertex);
        }
        result.loops.add(face, loop);
        result.origins.push_back(static_cast<std::uint32_t>(f));
      }
    }
    return result;
  }

  const PreparedScene& scene_;
  const FaceLoops& loops_;
  const GridRequest& request_;
  PointTable& points_;
  std::vector<std::uint32_t> plane_numbers_;  // by plane; kNone: no face of it is cut
  std::vector<MeshPlane> planes_;
};

}  // namespace

Expected<GridCut> cut_by_grids(const PreparedScene& scene, const FaceLoops& loops,
                               const GridRequest& request, PointTable& points) {
  return GridCutter(scene, loops, request, points).cut();
}

}  // namespace gnomon
