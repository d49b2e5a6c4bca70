// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/facing_chain/joined_parts.h"

#include "scene/geometry/joined_sets.h"

namespace gnomon::joined_parts {
namespace {

/// Which parts make one component.
scene_detail::JoinedSets joined_parts(const PreparedScene& scene, const EdgeUsers& users) {
  scene_detail::JoinedSets sets(scene.parts.size());
  for (EdgeId edge = 0; edge < scene.geometry.edges.size(); ++edge) {
    const auto around = users.of(edge);
    if (around.size() == 2) {
      sets.join(around[0].part, around[1].part);
    } else if (around.size() > 2) {
      for (const auto& [i, j] :
           pairs_around(scene.geometry.grid, scene.geometry.edges[edge], around)) {
        sets.join(around[i].part, around[j].part);
      }
    }
  }
  return sets;
}

}  // namespace

Partition partition_of(const PreparedScene& scene, const EdgeUsers& users) {
  scene_detail::JoinedSets sets = joined_parts(scene, users);
  Partition partition;
  partition.component_of.resize(scene.parts.size());
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const std::uint32_t first = sets.first(i);
    std::uint32_t& own = partition.component_of[i];
    if (first == i) {
      own = static_cast<std::uint32_t>(partition.parts.size());
      partition.parts.emplace_back();
    } else {
      own = partition.component_of[first];
    }
    partition.parts[own].push_back(i);
  }
  return partition;
}

}  // namespace gnomon::joined_parts
