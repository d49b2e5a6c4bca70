// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/volume_trees/balanced_prefix.h"

namespace gnomon {

SpacePrefix plan_space_prefix(std::span<const Box> receivers, std::uint32_t leaf_size) {
  SpacePrefix prefix;
  // What touches a plane goes both ways: boxes are rounded.
  const KdRules rules{
      .axes = 3, .least = 0, .most = 1, .touching_counts = true, .leaf_size = leaf_size};
  grow_kd_tree(receivers, rules, SpacePrefix::kLeaf, false,
               [&](const KdSplit& split, std::int32_t parent, bool is_front) {
                 const auto index = static_cast<std::int32_t>(prefix.nodes.size());
                 prefix.nodes.push_back({split});
                 if (parent != SpacePrefix::kLeaf) {
                   SpacePrefix::Node& above = prefix.nodes[static_cast<std::size_t>(parent)];
                   (is_front ? above.front : above.back) = index;
                 }
                 return index;
               });
  return prefix;
}

}  // namespace gnomon
