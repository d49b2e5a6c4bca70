// SPDX-License-Identifier: GPL-3.0-or-later
// Moves that put a point or directional light where it is special to a polygon, and polygons where
// they are special as seen from a light.
#include <array>
#include <optional>

#include "fuzz/moves/move_tools.h"

namespace gnomon::fuzz {
namespace {

bool lamp(Scene& scene, Random& random, const Vector& at) {
  return set_light(scene, random, LightType::kPoint, position_of(at, scene.numbers));
}
bool rounded_lamp(Scene& scene, Random& random, const Vector& at) {
  return set_light(scene, random, LightType::kPoint, rounded_position(at, scene.numbers));
}

bool light_in_plane(Scene& scene, Random& random) {
  return lamp(scene, random, plane_point(random_corner(scene, random), random));
}

bool light_on_face(Scene& scene, Random& random) {
  return lamp(scene, random, inner_point(random_corner(scene, random), random));
}

bool light_on_edge(Scene& scene, Random& random) {
  return lamp(scene, random, edge_point(random_corner(scene, random), random));
}

bool light_on_edge_line(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  static constexpr int kHalves[] = {-6, -4, -2, -1, 3, 4, 6, 10};
  return lamp(scene, random, corner.at(mpq_class(kHalves[random.below(8)]) / 2, 0));
}

bool light_at_vertex(Scene& scene, Random& random) {
  return lamp(scene, random, random_corner(scene, random).a);
}

bool light_far(Scene& scene, Random& random) {
  const Vector w = free_vector(scene, random);
  const mpq_class times = random.chance(1, 2)
                              ? mpq_class(1e12)
                              : power_of_two(static_cast<int>(random.between(24, 60)));
  return rounded_lamp(scene, random, free_point(scene, random) + times * w);
}

bool light_near(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector at = random.chance(1, 3)   ? corner.a
                    : random.chance(1, 2) ? edge_point(corner, random)
                                          : inner_point(corner, random);
  // Of the polygon's size, not the scene's.
  const Vector off = random.chance(1, 2) ? corner.u : cross(corner.u, corner.v);
  const int shift = exponent_of(off[0] != 0   ? off[0]
                                : off[1] != 0 ? off[1]
                                              : off[2]) -
                    exponent_of(box_of(corner.loop).extent());
  const Vector hair = power_of_two(-shift - static_cast<int>(random.between(31, 50))) * off;
  return rounded_lamp(scene, random, at + hair);
}

bool grazing_light(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector at = plane_point(corner, random);
  if (random.chance(1, 2) && scene.numbers == NumberMeaning::kDouble) {
    const auto position = rounded_position(at, scene.numbers);
    return position && set_light(scene, random, LightType::kPoint, nudged(*position, random));
  }
  return rounded_lamp(scene, random, at + hair(scene, random, 31, 50));
}

std::optional<Vector> direction_in_plane(const Corner& corner, Random& random) {
  const mpq_class s = dyadic(random, -3, 3, 0), t = dyadic(random, -3, 3, 0);
  const Vector direction = s * corner.u + t * corner.v;
  if (is_zero(direction)) return std::nullopt;
  return direction;
}

bool sun_in_plane(Scene& scene, Random& random) {
  const auto direction = direction_in_plane(random_corner(scene, random), random);
  return direction &&
         set_light(scene, random, LightType::kDirectional, position_of(*direction, scene.numbers));
}

bool sun_along_edge(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const mpq_class sign(random.chance(1, 2) ? 1 : -1);
  return set_light(scene, random, LightType::kDirectional,
                   position_of(sign * corner.u, scene.numbers));
}

bool grazing_sun(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const auto direction = direction_in_plane(corner, random);
  if (!direction) return false;
  if (random.chance(1, 2) && scene.numbers == NumberMeaning::kDouble) {
    const auto position = rounded_position(*direction, scene.numbers);
    return position && set_light(scene, random, LightType::kDirectional, nudged(*position, random));
  }
  const int shift = static_cast<int>(random.between(31, 50));
  const Vector off = free_vector(scene, random);
  const int size = exponent_of(box_of(corner.loop).extent()) - exponent_of(box_of(scene).extent());
  return set_light(scene, random, LightType::kDirectional,
                   rounded_position(*direction + power_of_two(size - shift) * off, scene.numbers));
}

/// A light that the scene has, or a new lamp.
struct Eye {
  Vector p;
  bool finite = true;

  /// On the line from the eye through p: `share` of the way to p, or p moved along the direction.
  Vector along(const Vector& at, const mpq_class& share) const {
    return finite ? p + share * (at - p) : at + (1 - share) * p;
  }
};

std::optional<Eye> eye_of(Scene& scene, Random& random) {
  std::vector<const Light*> lights;
  for (const Light& light : scene.lights) {
    if (!light.has_area()) lights.push_back(&light);
  }
  if (lights.empty()) {
    const Vector at = free_point(scene, random);
    if (!lamp(scene, random, at)) return std::nullopt;
    return Eye{at, true};
  }
  const Light& light = *lights[random.below(lights.size())];
  Eye eye{exact(light.position), light.is_point()};
  if (!eye.finite) {  // to the scene's size
    mpq_class largest = 0;
    for (const mpq_class& c : eye.p) {
      if (abs(c) > largest) largest = abs(c);
    }
    eye.p = power_of_two(exponent_of(box_of(scene).extent()) - exponent_of(largest)) * eye.p;
  }
  return eye;
}

mpq_class share_of_way(Random& random) {
  static constexpr int kQuarters[] = {1, 2, 3, 2, 6, 8};
  return mpq_class(kQuarters[random.below(6)]) / 4;
}

bool shadow_edges(Scene& scene, Random& random) {
  const auto eye = eye_of(scene, random);
  if (!eye) return false;
  const Corner corner = random_corner(scene, random);
  // Two points of the plane through the eye and the edge, at different depths mostly.
  const auto point = [&]() {
    const mpq_class s = dyadic(random, -2, 6, 2);
    return eye->along(corner.at(s, 0), share_of_way(random));
  };
  const Vector p = point(), q = point();
  return add_polygon(scene, random, completed(scene, random, {p, q}));
}

bool shadow_vertex_on_edge(Scene& scene, Random& random) {
  const auto eye = eye_of(scene, random);
  if (!eye) return false;
  const Corner corner = random_corner(scene, random);
  const Vector on_edge = edge_point(corner, random);
  return add_polygon(scene, random,
                     completed(scene, random, {eye->along(on_edge, share_of_way(random))}));
}

bool shadow_vertices(Scene& scene, Random& random) {
  const auto eye = eye_of(scene, random);
  if (!eye) return false;
  const Corner corner = random_corner(scene, random);
  const mpq_class share = share_of_way(random);
  std::vector<Vector> first = {eye->along(corner.a, share)};
  // A whole edge behind an edge, for half of them.
  if (random.chance(1, 2)) first.push_back(eye->along(corner.next(), share));
  return add_polygon(scene, random, completed(scene, random, first));
}

/// Three sticks round a triangle, each rising from under one to above the next.
bool cyclic_overlap(Scene& scene, Random& random) {
  const Vector origin = free_point(scene, random);
  const mpq_class step = power_of_two(exponent_of(box_of(scene).extent()) - 4);
  std::array<std::size_t, 3> axes = {0, 1, 2};
  random.shuffle<std::size_t>(axes);
  std::array<mpq_class, 3> signs;
  for (mpq_class& sign : signs) sign = random.chance(1, 2) ? step : mpq_class(-step);
  const auto point = [&](int x, int y, int z) {
    Vector p = origin;
    p[axes[0]] += x * signs[0];
    p[axes[1]] += y * signs[1];
    p[axes[2]] += z * signs[2];
    return p;
  };
  const auto stick = [&](std::array<int, 2> from, std::array<int, 2> to, int w, int h) {
    return add_polygon(scene, random,
                       {point(from[0], from[1], -2), point(from[0] + w, from[1] + h, -2),
                        point(to[0] + w, to[1] + h, 10), point(to[0], to[1], 10)});
  };
  if (!stick({-2, 0}, {10, 0}, 0, 1) || !stick({10, -2}, {-2, 10}, 1, 0) ||
      !stick({0, 10}, {0, -2}, 1, 0)) {
    return false;
  }
  if (random.chance(1, 2))
    return lamp(scene, random, point(3, 3, static_cast<int>(random.between(20, 60))));
  Vector direction = point(0, 0, 16);
  direction = direction - origin;
  return set_light(scene, random, LightType::kDirectional, position_of(direction, scene.numbers));
}

}  // namespace

std::vector<Move> light_moves() {
  constexpr MoveGroup kGroup = MoveGroup::kLight;
  return {
      {Kind::kLightInPlane, kGroup, light_in_plane},
      {Kind::kLightOnFace, kGroup, light_on_face},
      {Kind::kLightOnEdge, kGroup, light_on_edge},
      {Kind::kLightOnEdgeLine, kGroup, light_on_edge_line},
      {Kind::kLightAtVertex, kGroup, light_at_vertex},
      {Kind::kLightFar, kGroup, light_far},
      {Kind::kLightNear, kGroup, light_near},
      {Kind::kGrazingLight, kGroup, grazing_light},
      {Kind::kSunInPlane, kGroup, sun_in_plane},
      {Kind::kSunAlongEdge, kGroup, sun_along_edge},
      {Kind::kGrazingSun, kGroup, grazing_sun},
      {Kind::kShadowEdges, kGroup, shadow_edges},
      {Kind::kShadowVertexOnEdge, kGroup, shadow_vertex_on_edge},
      {Kind::kShadowVertices, kGroup, shadow_vertices},
      {Kind::kCyclicOverlap, kGroup, cyclic_overlap},
  };
}

}  // namespace gnomon::fuzz
