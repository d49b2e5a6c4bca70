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

std::vector<Side> facing_sides(const PreparedScene& scene, const LightPoint& light) {
  const std::vector<Sign> signs = light_signs(scene.geometry, light);
  std::vector<Side> facing;
  facing.reserve(scene.parts.size());
  for (const Part& part : scene.parts) {
    const Sign sign = part.flipped ? -signs[part.plane] : signs[part.plane];
    const bool turns_away = sign == Sign::kNegative && !part.two_sided;
    facing.push_back(turns_away ? Side::kOn : side_of(sign));
  }
  return facing;
}

}  // namespace gnomon
