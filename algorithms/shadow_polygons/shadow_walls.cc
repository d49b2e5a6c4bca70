// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shadow_polygons/shadow_walls.h"

#include "gnomon/algorithms/facing_chain.h"

namespace gnomon {

std::vector<ShadowWall> shadow_walls(const PreparedScene& scene, std::span<const Side> facing,
                                     VolumesOf volumes) {
  std::vector<ShadowWall> walls;
  if (volumes == VolumesOf::kChain) {
    for (const ContourEdge& edge : facing_chain(scene, facing).contour) {
      walls.push_back({edge.edge, edge.multiplicity});
    }
    return walls;
  }
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    if (facing[i] == Side::kOn || !scene.parts[i].casts) continue;
    for (const PlaneRef edge : scene.edges(scene.parts[i])) {
      walls.push_back({facing[i] == Side::kFront ? edge : -edge, 1});
    }
  }
  return walls;
}

}  // namespace gnomon
