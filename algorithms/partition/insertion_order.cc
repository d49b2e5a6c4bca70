// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/insertion_order.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace gnomon {

std::vector<std::uint32_t> in_order(InsertionOrder order, const PreparedScene& scene,
                                    const LightPoint& light, std::span<const std::uint32_t> parts) {
  if (order == InsertionOrder::kFile) return {parts.begin(), parts.end()};
  const double sense = order == InsertionOrder::kNearFirst ? 1 : -1;
  const auto distance = [&](VertexId v) {
    const std::array<double, 3>& x = scene.geometry.positions[v];
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = light.directional ? x[k] : light.nearest[k] - x[k];
      sum += light.directional ? -along * light.nearest[k] : along * along;
    }
    return sum;
  };
  std::vector<std::pair<double, std::uint32_t>> sorted;
  sorted.reserve(parts.size());
  for (const std::uint32_t part : parts) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const VertexId v : scene.loop(scene.parts[part])) {
      nearest = std::min(nearest, distance(v));
    }
    sorted.emplace_back(sense * nearest, part);
  }
  std::ranges::stable_sort(sorted, {}, &std::pair<double, std::uint32_t>::first);
  std::vector<std::uint32_t> result;
  result.reserve(parts.size());
  for (const auto& [nearest, part] : sorted) result.push_back(part);
  return result;
}

}  // namespace gnomon
