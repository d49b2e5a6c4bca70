// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/facing_sides.h"

#include <gmpxx.h>

#include <array>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

using GridVector = std::array<mpz_class, 3>;

/// On which side of each support plane the light is.
std::vector<Sign> light_signs(const Geometry& geometry, const LightPoint& light) {
  const auto point = [&](VertexId vertex) {
    return GridVector{geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1),
                      geometry.grid.at(vertex, 2)};
  };
  std::vector<Sign> signs;
  signs.reserve(geometry.planes.size());
  for (const SupportTriple& plane : geometry.planes) {
    const GridVector a = point(plane.a);
    const GridVector normal = cross(minus(point(plane.b), a), minus(point(plane.c), a));
    const GridVector towards = light.directional ? light.grid : minus(light.grid, a);
    signs.push_back(sign_of(mpz_class(dot(normal, towards))));
  }
  return signs;
}

}  // namespace

std::vector<Sign> signs_at_light(const PreparedScene& scene, const LightPoint& light) {
  const std::vector<Sign> of_planes = light_signs(scene.geometry, light);
  std::vector<Sign> signs;
  signs.reserve(scene.parts.size());
  for (const Part& part : scene.parts) {
    signs.push_back(part.flipped ? -of_planes[part.plane] : of_planes[part.plane]);
  }
  return signs;
}

std::vector<Side> facing_sides(const PreparedScene& scene, std::span<const Sign> signs) {
  std::vector<Side> facing;
  facing.reserve(signs.size());
  for (std::size_t p = 0; p < signs.size(); ++p) {
    const bool turns_away = signs[p] == Sign::kNegative && !scene.parts[p].two_sided;
    facing.push_back(turns_away ? Side::kOn : side_of(signs[p]));
  }
  return facing;
}

std::vector<Side> facing_sides(const PreparedScene& scene, const LightPoint& light) {
  return facing_sides(scene, signs_at_light(scene, light));
}

}  // namespace gnomon
