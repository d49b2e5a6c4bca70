// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/ridge_edges/facing_sides.h"

#include "algorithms/ridge_edges/light_directions.h"
#include "scene/base/vectors.h"

namespace gnomon {

std::vector<Sign> signs_at_light(const PreparedScene& scene, const LightPoint& light) {
  const auto point = [&](VertexId vertex) {
    return DirectionVector{scene.geometry.grid.at(vertex, 0), scene.geometry.grid.at(vertex, 1),
                           scene.geometry.grid.at(vertex, 2)};
  };
  std::vector<Sign> signs;
  signs.reserve(scene.parts.size());
  for (const Part& part : scene.parts) {
    const SupportTriple& plane = scene.geometry.planes[part.plane];
    const DirectionVector a = point(plane.a);
    const DirectionVector normal = cross(minus(point(plane.b), a), minus(point(plane.c), a));
    const Sign sign =
        sign_of(mpz_class(dot(normal, light.directional ? light.grid : minus(light.grid, a))));
    signs.push_back(part.flipped ? -sign : sign);
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

}  // namespace gnomon
