// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/prepare/prepare_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/geometry/loop_geometry.h"

namespace gnomon::scene_detail {
namespace {

using Vector = Vec3<mpz_class>;

class RegionMaker {
 public:
  explicit RegionMaker(PreparedScene& out)
      : geometry_(out.geometry), first_new_(static_cast<VertexId>(out.geometry.positions.size())) {}

  /// Not valid() if the points are on one line.
  PlaneRef add(const GridPoint* points, const RegionPlane& plane) {
    const Vector a = vector(points[0]);
    const Vector normal = cross(vector(points[1]) - a, vector(points[2]) - a);
    if (normal.is_zero()) return {};
    for (PlaneId id = 0; id < geometry_.planes.size(); ++id) {
      const SupportTriple& known = geometry_.planes[id];
      const Vector p = at(known.a), q = at(known.b), r = at(known.c);
      if (dot(normal, p - a) != 0 || dot(normal, q - a) != 0 || dot(normal, r - a) != 0) continue;
      return PlaneRef(id, dot(normal, cross(q - p, r - p)) < 0);
    }
    geometry_.planes.push_back(
        {vertex(points[0], plane[0]), vertex(points[1], plane[1]), vertex(points[2], plane[2])});
    return PlaneRef(static_cast<PlaneId>(geometry_.planes.size() - 1));
  }

  /// Puts the new vertices after those of polygons.
  void finish() {
    if (added_.empty()) return;
    std::vector<mpz_class> all;
    all.reserve(3 * (first_new_ + added_.size()));
    for (VertexId v = 0; v < first_new_; ++v) {
      for (int k = 0; k < 3; ++k) all.push_back(geometry_.grid.at(v, k));
    }
    for (const GridPoint& point : added_) all.insert(all.end(), point.begin(), point.end());
    geometry_.positions.insert(geometry_.positions.end(), nearest_.begin(), nearest_.end());
    geometry_.grid = GridPositions::from(std::move(all));
    geometry_.light_vertices += static_cast<std::uint32_t>(added_.size());
  }

 private:
  static Vector vector(const GridPoint& p) { return {p[0], p[1], p[2]}; }
  Vector at(VertexId v) const {
    if (v >= first_new_) return vector(added_[v - first_new_]);
    return point<mpz_class>(geometry_.grid, v);
  }
  VertexId vertex(const GridPoint& point, const Position& position) {
    const GridPositions& grid = geometry_.grid;
    for (VertexId v = 0; v < first_new_; ++v) {
      if (grid.at(v, 0) == point[0] && grid.at(v, 1) == point[1] && grid.at(v, 2) == point[2]) {
        return v;
      }
    }
    const auto found = std::ranges::find(added_, point);
    const auto place = static_cast<VertexId>(found - added_.begin());
    if (found == added_.end()) {
      added_.push_back(point);
      nearest_.push_back({position[0].nearest(), position[1].nearest(), position[2].nearest()});
    }
    return first_new_ + place;
  }

  Geometry& geometry_;
  VertexId first_new_;
  std::vector<GridPoint> added_;
  std::vector<std::array<double, 3>> nearest_;  // of each of them
};

Error on_a_line(const Scene& scene, std::size_t light, std::size_t plane) {
  Error error;
  error.code = ErrorCode::kGeometry;
  error.where.file = scene.file;
  error.where.pointer = fmt::format("/lights/{}/region/{}", light, plane);
  error.what = fmt::format("light '{}': the three points of plane {} of its region lie on one line",
                           scene.lights[light].id, plane);
  error.expected =
      "three points that are corners of a triangle, counter-clockwise seen from inside";
  return error;
}

}  // namespace

std::vector<GridPoint> grid_points(const ExactGrid& grid, std::size_t first) {
  const std::size_t count = (grid.is_narrow ? grid.narrow.size() : grid.wide.size()) / 3;
  std::vector<GridPoint> points;
  for (std::size_t i = first; i < count; ++i) {
    points.push_back({grid.at(i, 0), grid.at(i, 1), grid.at(i, 2)});
  }
  return points;
}

std::optional<Error> prepare_regions(const Scene& scene, const std::vector<GridPoint>& points,
                                     PreparedScene& out) {
  if (points.empty()) return std::nullopt;
  RegionMaker maker(out);
  std::size_t next = 0;
  for (PreparedLight& light : out.lights) {
    const std::size_t planes = scene.lights[light.light].region.size();
    for (std::size_t i = 0; i < planes; ++i, next += 3) {
      const PlaneRef plane = maker.add(&points[next], scene.lights[light.light].region[i]);
      if (!plane.valid()) return on_a_line(scene, light.light, i);
      light.region.push_back(plane);
    }
  }
  maker.finish();
  return std::nullopt;
}

}  // namespace gnomon::scene_detail
