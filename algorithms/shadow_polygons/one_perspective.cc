// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shadow_polygons/one_perspective.h"

#include <array>
#include <cstddef>

namespace gnomon {

std::int32_t turn_in_one_perspective(const PreparedScene& scene, const LightPoint& light,
                                     VertexId a, VertexId b) {
  if (light.directional) return 1;
  std::array<double, 3> middle{};
  for (const VertexId v : scene.loop_vertices) {
    for (std::size_t k = 0; k < 3; ++k) middle[k] += scene.geometry.positions[v][k];
  }
  const auto depth = [&](VertexId v) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double axis =
          middle[k] / static_cast<double>(scene.loop_vertices.size()) - light.nearest[k];
      sum += axis * (scene.geometry.positions[v][k] - light.nearest[k]);
    }
    return sum;
  };
  const double product = depth(a) * depth(b);
  return product > 0 ? 1 : product < 0 ? -1 : 0;
}

}  // namespace gnomon
