// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "algorithms/partition/fractions.h"
#include "kernel/implicit/implicit_scene_space.h"
#include "kernel/signs/nearest_double.h"

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

}  // namespace

GridLines::GridLines(mpq_class step, bool rounded)
    : step_(std::move(step)), nearest_step_(step_.get_d()), rounded_(rounded) {
  constexpr std::size_t kShort = 53;
  is_short_ = mpz_sizeinbase(step_.get_num_mpz_t(), 2) <= kShort &&
              mpz_sizeinbase(step_.get_den_mpz_t(), 2) <= kShort;
}

double GridLines::rounded_at(std::int64_t line) const {
  if (is_short_) {
    const double numerator = static_cast<double>(line) * step_.get_num().get_d();
    // Below 2^53 the product is exact.
    if (std::fabs(numerator) < 0x1p53) return numerator / step_.get_den().get_d();
  }
  return nearest_double(step_ * mpq_class(static_cast<long>(line)));
}

mpq_class GridLines::at(std::int64_t line) const {
  return rounded_ ? mpq_class(rounded_at(line)) : step_ * mpq_class(static_cast<long>(line));
}

std::int64_t GridLines::place(const PointTable& points, std::uint32_t point, int axis) const {
  const auto k = static_cast<std::size_t>(axis);
  const ExactPoint& exact = points.exact(point);
  if (!rounded_) {
    mpz_class quotient, rest;
    const mpz_class dividend = exact.numerator[k] * step_.get_den();
    const mpz_class divisor = exact.denominator * step_.get_num();
    mpz_fdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), dividend.get_mpz_t(), divisor.get_mpz_t());
    return 2 * std::int64_t{quotient.get_si()} + (sgn(rest) != 0 ? 1 : 0);
  }
  // Rounding to the nearest double keeps the order, and lines are doubles: only a coordinate whose
  // nearest double is a line may be on either side of it.
  const double nearest = points.nearest(point)[k];
  auto line = static_cast<std::int64_t>(std::floor(nearest / nearest_step_));
  while (rounded_at(line) > nearest) --line;
  while (rounded_at(line + 1) <= nearest) ++line;
  if (rounded_at(line) != nearest) return 2 * line + 1;
  const mpq_class at(nearest);
  const int order = cmp(exact.numerator[k] * at.get_den(), at.get_num() * exact.denominator);
  return 2 * line + (order > 0 ? 1 : order < 0 ? -1 : 0);
}

MeshPlane mesh_plane(const PreparedScene& scene, PlaneId plane) {
  const Geometry& geometry = scene.geometry;
  const ExactGeometry<mpz_class> exact(geometry);
  const auto [n, d] = exact.plane(plane);
  const Chart chart = chart_of(geometry, plane);
  MeshPlane result;
  // Position = origin + step * grid, so that n . position = n . origin + step * d.
  result.d = geometry.step * d;
  for (std::size_t k = 0; k < 3; ++k) {
    result.n[k] = n[k];
    result.d += geometry.origin[k] * n[k];
  }
  result.axes = {chart.u, chart.v};
  return result;
}

Expected<GridCut> cut_by_grids(const PreparedScene& scene, const FaceLoops& loops,
                               const GridRequest& request, PointTable& points) {
  const auto interrupted = [&] { return is_set(request.interrupted); };
  const auto stopped = [] { return fail(ErrorCode::kInterrupted, "interrupted while gridding"); };
  const std::size_t face_count = loops.faces.size();

  // Planes of the faces that are cut, computed once each.
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> plane_number(scene.geometry.planes.size(), kNone);
  std::vector<MeshPlane> planes;
  for (std::size_t f = 0; f < face_count; ++f) {
    if (request.grid_of[f] == kNoGrid) continue;
    const PlaneId plane = scene.parts[loops.faces[f].part].plane;
    if (plane_number[plane] != kNone) continue;
    plane_number[plane] = static_cast<std::uint32_t>(planes.size());
    planes.push_back(mesh_plane(scene, plane));
  }
  const auto plane_of = [&](const MeshFace& face) -> const MeshPlane& {
    return planes[plane_number[scene.parts[face.part].plane]];
  };

  // The cells of all faces are counted, roughly from above, before any is made.
  std::uint64_t cells = face_count;
  for (std::size_t f = 0; f < face_count && cells <= request.max_faces; ++f) {
    if (request.grid_of[f] == kNoGrid) continue;
    const GridLines& lines = request.grids[request.grid_of[f]];
    std::array<std::uint64_t, 2> across{1, 1};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto axis = static_cast<std::size_t>(plane_of(loops.faces[f]).axes[k]);
      double low = INFINITY, high = -INFINITY;
      for (const std::uint32_t vertex : loops.loop(loops.faces[f])) {
        low = std::min(low, points.nearest(vertex)[axis]);
        high = std::max(high, points.nearest(vertex)[axis]);
      }
      if (!(std::max(std::fabs(low), std::fabs(high)) < GridLines::kMostLines * lines.step())) {
        return fail(ErrorCode::kLimit, "the grid's step is too small for coordinates this large",
                    "a larger step");
      }
      across[k] += static_cast<std::uint64_t>(
          std::min((high - low) / lines.step(), static_cast<double>(request.max_faces)));
    }
    cells += across[0] * across[1] - 1;
  }
  if (cells > request.max_faces) {
    return fail(
        ErrorCode::kLimit,
        "the grid cuts the scene into more than " + std::to_string(request.max_faces) + " faces",
        "a larger step");
  }

  const EdgeList edges(loops, [&](std::size_t f) { return request.grid_of[f] != kNoGrid; });
  std::vector<std::uint8_t> asked(edges.size(), 0);
  for (std::size_t f = 0; f < face_count; ++f) {
    const std::uint8_t grid = request.grid_of[f];
    if (grid == kNoGrid) continue;
    const auto [u, v] = plane_of(loops.faces[f]).axes;
    const auto loop = loops.loop(loops.faces[f]);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      asked[edges.find(loop[i], loop[(i + 1) % loop.size()])] |=
          static_cast<std::uint8_t>(bit_of(grid, u) | bit_of(grid, v));
    }
  }
  std::vector<std::vector<NewPoint>> made(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t edge) {
    if (interrupted()) return;
    made[edge] =
        points_on_edge(points, edges.from(edge), edges.to(edge), asked[edge], request.grids);
  });
  if (interrupted()) return stopped();
  std::vector<std::vector<std::uint32_t>> inserted(edges.size());
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    for (NewPoint& point : made[edge]) inserted[edge].push_back(points.insert(std::move(point)));
  }
  made.clear();
  const FaceLoops fitted = insert_vertices(loops, edges, inserted);

  std::vector<FaceCut> cut(face_count);
  tbb::parallel_for(std::size_t{0}, face_count, [&](std::size_t f) {
    if (request.grid_of[f] == kNoGrid || interrupted()) return;
    const MeshFace& face = fitted.faces[f];
    FaceCutter cutter(points, request.grids[request.grid_of[f]], plane_of(face));
    cut[f] = cutter.cut(fitted.loop(face));
  });
  if (interrupted()) return stopped();
  GridCut result;
  std::vector<std::uint32_t> numbers, loop;
  for (std::size_t f = 0; f < face_count; ++f) {
    const MeshFace& face = fitted.faces[f];
    if (cut[f].counts.empty()) {
      result.loops.add(face, fitted.loop(face));
      result.origins.push_back(static_cast<std::uint32_t>(f));
      continue;
    }
    numbers.clear();
    for (NewPoint& point : cut[f].made) numbers.push_back(points.insert(std::move(point)));
    std::size_t at = 0;
    for (const std::uint32_t count : cut[f].counts) {
      loop.clear();
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t vertex = cut[f].corners[at++];
        loop.push_back((vertex & CutCorner::kNew) != 0 ? numbers[vertex & ~CutCorner::kNew]
                                                       : vertex);
      }
      result.loops.add(face, loop);
      result.origins.push_back(static_cast<std::uint32_t>(f));
    }
  }
  return result;
}

}  // namespace gnomon
