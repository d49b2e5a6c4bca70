// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/nearest_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gnomon/oracle/enclosure.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/geometry/space_loop.h"

namespace gnomon::oracle {

namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();

mpq_class squared_between(const RationalPoint& a, const RationalPoint& b) {
  const RationalPoint apart = space::minus(a, b);
  return space::dot(apart, apart);
}

/// A lower bound of the distance of two boxes, less what rounding adds.
double distance_of(const SpaceBox& a, const SpaceBox& b) {
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double apart = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    squared += apart * apart;
  }
  constexpr double kRounding = 1 - 0x1p-48;
  return std::sqrt(squared) * kRounding;
}

}  // namespace

NearestPlaces::NearestPlaces(const PreparedScene& scene) : scene_(scene) {
  const auto& positions = scene.geometry.positions;
  for (const VertexId vertex : scene.loop_vertices) {
    for (const double c : positions[vertex]) error_ = std::max(error_, std::fabs(c));
  }
  error_ *= 0x1p-51;
  std::vector<SpaceBox> boxes;
  planes_.reserve(scene.parts.size());
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const std::vector<Integers3> loop = grid_loop(scene, i);
    const ExactPlane support = support_of(scene, i);
    PartPlanes planes{scene_plane(scene.geometry, support), {}};
    planes.support.make_large();
    for (std::size_t e = 0; e < loop.size(); ++e) {
      ExactPlane edge;
      edge.normal = cross(support.normal, minus(loop[(e + 1) % loop.size()], loop[e]));
      edge.offset = dot(edge.normal, loop[e]);
      reduce(edge);
      planes.edges.push_back(scene_plane(scene.geometry, edge));
      planes.edges.back().make_large();
    }
    planes_.push_back(std::move(planes));
    SpaceBox box{{kFarAway, kFarAway, kFarAway}, {-kFarAway, -kFarAway, -kFarAway}};
    for (const VertexId vertex : scene.loop(scene.parts[i])) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], positions[vertex][k] - error_);
        box.high[k] = std::max(box.high[k], positions[vertex][k] + error_);
      }
    }
    boxes.push_back(box);
  }
  tree_ = SpaceTree(std::move(boxes));
}

std::vector<RationalPoint> NearestPlaces::loop_of(std::uint32_t part) const {
  const Geometry& geometry = scene_.geometry;
  std::vector<RationalPoint> loop;
  for (const VertexId vertex : scene_.loop(scene_.parts[part])) {
    RationalPoint& position = loop.emplace_back();
    for (int k = 0; k < 3; ++k) {
      position[k] = geometry.origin[k] + geometry.step * geometry.grid.at(vertex, k);
    }
  }
  return loop;
}

SpaceBox NearestPlaces::box_around(const RationalPoint& point, double margin) const {
  SpaceBox box{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double near = point[k].get_d();
    const double apart = margin + error_ + std::fabs(near) * 0x1p-51;
    box.low[k] = near - apart;
    box.high[k] = near + apart;
  }
  return box;
}

bool NearestPlaces::holds(const PartPlanes& planes, const Integers4& point) const {
  return std::ranges::all_of(
      planes.edges, [&](const Integers4& edge) { return sign_of_product(edge, point) >= 0; });
}

bool NearestPlaces::holds(std::uint32_t part, const RationalPoint& point) const {
  return holds(planes_[part], scene_point(point));
}

PolygonPlace NearestPlaces::on_part(std::uint32_t part, const RationalPoint& point) const {
  const PartPlanes& planes = planes_[part];
  const Integers4 own = scene_point(point);
  if (sign_of_product(planes.support, own) == 0) {
    return holds(planes, own) ? PolygonPlace{part, point, 0, 0} : on_border(part, point);
  }
  // Its foot on the support plane.
  const Integers3 normal = support_of(scene_, part).normal;
  RationalPoint n, base;
  const VertexId first = scene_.loop(scene_.parts[part])[0];
  const Geometry& geometry = scene_.geometry;
  for (int k = 0; k < 3; ++k) {
    n[k] = normal[k];
    base[k] = geometry.origin[k] + geometry.step * geometry.grid.at(first, k);
  }
  const mpq_class height = space::dot(n, space::minus(point, base));
  const mpq_class along = height / space::dot(n, n);
  PolygonPlace place{part, point, 0, mpq_class(height * along)};
  for (int k = 0; k < 3; ++k) place.point[k] -= along * n[k];
  if (!holds(planes, scene_point(place.point))) return on_border(part, point);
  place.distance = enclose_square_root(place.squared_distance).upper;
  return place;
}

PolygonPlace NearestPlaces::on_border(std::uint32_t part, const RationalPoint& point) const {
  const std::vector<RationalPoint> loop = loop_of(part);
  PolygonPlace best{part, loop[0], 0, squared_between(point, loop[0])};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const RationalPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const RationalPoint edge = space::minus(b, a);
    mpq_class t = space::dot(space::minus(point, a), edge) / space::dot(edge, edge);
    t = t < 0 ? mpq_class(0) : t > 1 ? mpq_class(1) : t;
    RationalPoint foot;
    for (int k = 0; k < 3; ++k) foot[k] = a[k] + t * edge[k];
    mpq_class squared = squared_between(point, foot);
    if (squared < best.squared_distance) {
      best.point = std::move(foot);
      best.squared_distance = std::move(squared);
    }
  }
  best.distance = enclose_square_root(best.squared_distance).upper;
  return best;
}

std::optional<PolygonPlace> NearestPlaces::on_polygon(std::uint32_t polygon,
                                                      const RationalPoint& point) const {
  const SpaceBox box = box_around(point, 0);
  std::optional<PolygonPlace> best;
  for (std::uint32_t part = scene_.first_part[polygon]; part < scene_.first_part[polygon + 1];
       ++part) {
    if (best && distance_of(tree_[part], box) > best->distance) continue;
    PolygonPlace place = on_part(part, point);
    if (!best || place.squared_distance < best->squared_distance) best = std::move(place);
    if (best->squared_distance == 0) break;
  }
  return best;
}

std::vector<PolygonPlace> NearestPlaces::all_near(const RationalPoint& point, double margin) const {
  const SpaceBox own = box_around(point, 0);
  double nearest = kFarAway;
  nearest = tree_.least(
      nearest, [&](const SpaceBox& box) { return distance_of(box, own); },
      [&](std::uint32_t part) {
        if (distance_of(tree_[part], own) >= nearest) return kFarAway;
        nearest = std::min(nearest, on_part(part, point).distance);
        return nearest;
      });
  std::vector<std::uint32_t> parts;
  const double most = round_up(nearest + margin);
  tree_.meeting(box_around(point, most), [&](std::uint32_t part) { parts.push_back(part); });
  std::ranges::sort(parts);
  std::vector<PolygonPlace> places;
  for (const std::uint32_t part : parts) {
    PolygonPlace place = on_part(part, point);
    if (place.distance > most) continue;
    const bool same =
        !places.empty() && scene_.parts[places.back().part].polygon == scene_.parts[part].polygon;
    if (!same) {
      places.push_back(std::move(place));
    } else if (place.squared_distance < places.back().squared_distance) {
      places.back() = std::move(place);
    }
  }
  return places;
}

}  // namespace gnomon::oracle
