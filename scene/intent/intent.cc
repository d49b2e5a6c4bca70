// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/intent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scene/base/parallel.h"
#include "scene/intent/components.h"
#include "scene/intent/near_planes.h"
#include "scene/intent/near_vertices.h"

namespace gnomon {

using scene_detail::LocalPoints;
using scene_detail::Vector;

namespace {

double median_diameter(const PreparedScene& scene, const LocalPoints& points) {
  // A sample does: it is a scale and no more.
  constexpr std::size_t kSample = 4096;
  std::vector<double> diameters;
  const std::size_t stride = scene.parts.size() / kSample + 1;
  for (std::size_t i = 0; i < scene.parts.size(); i += stride) {
    const auto loop = scene.loop(scene.parts[i]);
    long double greatest = 0;
    for (const VertexId vertex : loop) {
      greatest = std::max(greatest, length_of(points[vertex] - points[loop[0]]));
    }
    diameters.push_back(static_cast<double>(greatest));
  }
  if (diameters.empty()) return 0;
  const auto middle = diameters.begin() + static_cast<std::ptrdiff_t>(diameters.size() / 2);
  std::ranges::nth_element(diameters, middle);
  return *middle;
}

void measure_box(const PreparedScene& prepared, Intent& intent) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity},
      high{-kInfinity, -kInfinity, -kInfinity};
  for (const std::array<double, 3>& position : prepared.geometry.polygon_positions()) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], position[k]);
      high[k] = std::max(high[k], position[k]);
    }
  }
  if (prepared.geometry.polygon_positions().empty()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    intent.farthest_coordinate =
        std::max({intent.farthest_coordinate, std::abs(low[k]), std::abs(high[k])});
  }
  intent.diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

/// Greatest distance of a vertex from the plane that lies halfway between the outermost ones along
/// the area vector.
double bend_of(const PreparedScene& prepared, const LocalPoints& points, std::uint32_t polygon) {
  Vector area;
  std::vector<Vector> corners;
  for (std::uint32_t p = prepared.first_part[polygon]; p < prepared.first_part[polygon + 1]; ++p) {
    const auto loop = prepared.loop(prepared.parts[p]);
    area = area + points.area_vector(loop);
    for (const VertexId vertex : loop) corners.push_back(points[vertex]);
  }
  const Vector origin = corners[0];
  long double low = 0, high = 0;
  for (const Vector& corner : corners) {
    const long double at = dot_of(area, corner - origin);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return static_cast<double>((high - low) / (2 * length_of(area)));
}

void find_bent(const PreparedScene& prepared, const LocalPoints& points, Intent& intent) {
  for (const PreparationNote& note : prepared.notes) {
    if (note.repair != Repair::kNotPlanar) continue;
    if (!intent.bent.empty() && intent.bent.back().polygon == note.polygon) continue;
    if (prepared.first_part[note.polygon] == prepared.first_part[note.polygon + 1]) continue;
    const double distance = bend_of(prepared, points, note.polygon);
    if (distance <= intent.near) intent.bent.push_back({note.polygon, distance});
  }
}

// ------------------------------------------------------------------------- lights and closed
// solids

/// The box of each closed component, and which points are inside.
class Solids {
 public:
  Solids(const PreparedScene& prepared, const LocalPoints& points,
         const std::vector<ClosedComponent>& components)
      : prepared_(prepared), points_(points), components_(components) {
    for (const ClosedComponent& component : components) {
      scene_detail::Box& box = boxes_.emplace_back(scene_detail::Box::empty());
      for (const std::uint32_t polygon : component.polygons) add(polygon, box);
    }
  }

  /// Is it inside the component with this index?
  bool hold(std::size_t component, const Vector& point) const {
    scene_detail::Box place = scene_detail::Box::empty();
    for (int k = 0; k < 3; ++k) {
      place.add(k, static_cast<double>(point[k]), static_cast<double>(point[k]));
    }
    return boxes_[component].meets(place) &&
           is_inside(prepared_, points_, components_[component], point);
  }

 private:
  void add(std::uint32_t polygon, scene_detail::Box& box) const {
    for (std::uint32_t p = prepared_.first_part[polygon]; p < prepared_.first_part[polygon + 1];
         ++p) {
      for (const VertexId vertex : prepared_.loop(prepared_.parts[p])) {
        const Vector at = points_[vertex];
        for (int k = 0; k < 3; ++k) {
          box.add(k, static_cast<double>(at[k]), static_cast<double>(at[k]));
        }
      }
    }
  }

  const PreparedScene& prepared_;
  const LocalPoints& points_;
  const std::vector<ClosedComponent>& components_;
  std::vector<scene_detail::Box> boxes_;
};

/// The point, or the middle of the area light.
Vector place_of(const LocalPoints& points, const PreparedLight& light) {
  if (light.is_point()) return points.of_grid(light.point.grid);
  Vector sum;
  for (const auto& corner : light.area_loop) sum = sum + points.of_grid(corner);
  return (1 / static_cast<long double>(light.area_loop.size())) * sum;
}

void find_lights_inside(const PreparedScene& prepared, const LocalPoints& points,
                        const Solids& solids, Intent& intent) {
  for (const PreparedLight& light : prepared.lights) {
    if (light.is_directional()) continue;
    const Vector place = place_of(points, light);
    for (std::size_t i = 0; i < intent.closed.size(); ++i) {
      ClosedComponent& component = intent.closed[i];
      if (component.orientation != ComponentOrientation::kFlat && solids.hold(i, place)) {
        component.lights_inside.push_back(light.light);
      }
    }
  }
}

void find_cavities(const PreparedScene& prepared, const LocalPoints& points, const Solids& solids,
                   Intent& intent) {
  for (ClosedComponent& inner : intent.closed) {
    if (inner.orientation != ComponentOrientation::kInwards) continue;
    const Part& part = prepared.parts[prepared.first_part[inner.polygons[0]]];
    const Vector place = points[prepared.loop(part)[0]];
    for (std::size_t i = 0; i < intent.closed.size() && !inner.is_cavity; ++i) {
      inner.is_cavity =
          intent.closed[i].orientation == ComponentOrientation::kOutwards && solids.hold(i, place);
    }
  }
}

// --------------------------------------------------------------------- polygons that face no light

/// Looks at parts with sure signs only: who is nearly edge-on to a light may face it.
class Facing {
 public:
  Facing(const PreparedScene& prepared, const LocalPoints& points)
      : prepared_(prepared), points_(points) {
    for (const PreparedLight& light : prepared.lights) {
      LightPlace& place = lights_.emplace_back();
      place.is_directional = light.is_directional();
      if (light.is_directional()) {
        place.points.push_back(direction_of(light.point));
      } else if (light.is_point()) {
        place.points.push_back(points.of_grid(light.point.grid));
      } else {
        for (const auto& corner : light.area_loop) place.points.push_back(points.of_grid(corner));
      }
    }
  }

  std::size_t light_count() const { return lights_.size(); }

  /// The front of the part is turned away from every light.
  bool faces_nothing(const Part& part) const {
    const auto loop = prepared_.loop(part);
    const Vector area = points_.area_vector(loop), origin = points_[loop[0]];
    const long double size = length_of(area);
    return std::ranges::none_of(lights_, [&](const LightPlace& light) {
      return std::ranges::any_of(light.points, [&](const Vector& point) {
        const Vector to_light = light.is_directional ? point : point - origin;
        constexpr long double kSure = 1e-12L;
        return !(dot_of(area, to_light) < -kSure * size * length_of(to_light));
      });
    });
  }

 private:
  struct LightPlace {
    bool is_directional = false;
    std::vector<Vector> points;
  };

  /// As long as its greatest component, which is 1.
  static Vector direction_of(const LightPoint& light) {
    mpz_class greatest = 0;
    for (const mpz_class& component : light.grid)
      greatest = std::max(greatest, mpz_class(abs(component)));
    const auto at = [&](std::size_t k) {
      mpq_class share(light.grid[k], greatest);
      share.canonicalize();
      return static_cast<long double>(share.get_d());
    };
    return {at(0), at(1), at(2)};
  }

  const PreparedScene& prepared_;
  const LocalPoints& points_;
  std::vector<LightPlace> lights_;
};

/// Polygons of open components all of which face nothing, without those that lie on others.
void find_facing_nothing(const Scene& scene, const PreparedScene& prepared,
                         const LocalPoints& points, const scene_detail::Components& components,
                         const std::vector<scene_detail::Box>& boxes,
                         const scene_detail::BoxTree& tree, Intent& intent) {
  const Facing facing(prepared, points);
  constexpr std::size_t kMostLooks = 20'000'000;
  if (facing.light_count() == 0 || facing.light_count() * prepared.parts.size() > kMostLooks)
    return;
  intent.facing_was_looked_at = true;
  const std::size_t polygons = scene.polygons.size();
  std::vector<std::uint8_t> is_candidate(polygons, 1);
  const auto& first = components.first_polygon;
  for (const ClosedComponent& component : intent.closed)
    is_candidate[first[component.polygons[0]]] = 0;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    if (is_candidate[first[p]] == 0) continue;
    for (std::uint32_t i = prepared.first_part[p]; i < prepared.first_part[p + 1]; ++i) {
      const Part& part = prepared.parts[i];
      if (part.two_sided || !facing.faces_nothing(part)) is_candidate[first[p]] = 0;
    }
  }
  // A window in its wall looks where the wall looks.
  for (const NearlyCoplanarPair& pair : intent.nearly_coplanar)
    is_candidate[first[pair.polygon]] = 0;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    if (is_candidate[first[p]] == 0) continue;
    for (std::uint32_t i = prepared.first_part[p]; i < prepared.first_part[p + 1]; ++i) {
      tree.for_each_that_meets(boxes[i], [&](std::uint32_t other) {
        const Part& part = prepared.parts[other];
        if (part.polygon != p && part.plane == prepared.parts[i].plane &&
            first[part.polygon] != first[p]) {
          is_candidate[first[p]] = 0;
        }
      });
    }
  }
  for (std::uint32_t p = 0; p < polygons; ++p) {
    const bool dropped = prepared.first_part[p] == prepared.first_part[p + 1];
    if (is_candidate[first[p]] != 0 && !dropped) intent.facing_nothing.push_back(p);
  }
}

}  // namespace

bool Intent::is_seen_through(const ClosedComponent& component) const {
  return component.orientation == ComponentOrientation::kOutwards && !component.two_sided &&
         !component.lights_inside.empty();
}

bool Intent::is_inside_out(const ClosedComponent& component) const {
  return component.orientation == ComponentOrientation::kInwards && !component.two_sided &&
         component.lights_inside.empty() && !component.is_cavity;
}

bool Intent::is_doubtful() const {
  return !nearly_coplanar.empty() || !near_vertices.empty() || !bent.empty() ||
         !facing_nothing.empty() || is_far_from_origin() ||
         std::ranges::any_of(closed, [&](const ClosedComponent& component) {
           return is_seen_through(component) || is_inside_out(component) ||
                  component.orientation == ComponentOrientation::kMixed;
         });
}

Intent find_intent(const Scene& scene, const PreparedScene& prepared,
                   const IntentOptions& options) {
  constexpr double kNearShare = 1e-5;
  Intent intent;
  const LocalPoints points(prepared);
  intent.near = options.near;
  intent.is_partial = prepared.parts.size() > options.most_parts;
  measure_box(prepared, intent);
  // Beyond the range of doubles there is nothing to measure with.
  const double step = prepared.geometry.step.get_d();
  if (!std::isfinite(intent.diagonal) || !std::isfinite(step) || step == 0) {
    intent.is_partial = true;
    return intent;
  }
  if (intent.near <= 0) intent.near = kNearShare * median_diameter(prepared, points);
  find_bent(prepared, points, intent);
  if (intent.is_partial) return intent;
  const std::vector<scene_detail::Box> boxes =
      scene_detail::boxes_of_parts(prepared, points, intent.near);
  const scene_detail::BoxTree tree(boxes);
  intent.nearly_coplanar =
      scene_detail::find_nearly_coplanar(prepared, points, boxes, tree, intent.near);
  intent.near_vertices = scene_detail::find_near_vertices(prepared, points, intent.near);
  intent.near_edges = scene_detail::find_near_edges(prepared, intent.near_vertices);
  scene_detail::Components components = scene_detail::find_components(scene, prepared, points);
  intent.closed = std::move(components.closed);
  const Solids solids(prepared, points, intent.closed);
  find_lights_inside(prepared, points, solids, intent);
  find_cavities(prepared, points, solids, intent);
  find_facing_nothing(scene, prepared, points, components, boxes, tree, intent);
  return intent;
}

}  // namespace gnomon
