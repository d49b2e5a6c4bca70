// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/facing_chain/joined_parts.h"

#include <numeric>

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
  const auto count = static_cast<std::uint32_t>(scene.parts.size());
  Partition partition;
  partition.component_of.resize(count);
  std::vector<std::uint32_t>& first = partition.first;
  first.push_back(0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t known = sets.first(i);  // the first part of its component
    std::uint32_t& own = partition.component_of[i];
    if (known == i) {
      own = static_cast<std::uint32_t>(partition.size());
      first.push_back(0);
    } else {
      own = partition.component_of[known];
    }
    ++first[own + 1];  // the number of its parts, until all are summed
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  partition.members.resize(count);
  std::vector<std::uint32_t> place(first.begin(), first.end() - 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    partition.members[place[partition.component_of[i]]++] = i;
  }
  return partition;
}

}  // namespace gnomon::joined_parts
