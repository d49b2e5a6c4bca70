// SPDX-License-Identifier: LGPL-3.0-or-later
// What the trees of shadow planes of svbsp and svbsp-full have in common: cells that are OUT or IN,
// the balanced prefix on top, and how large they may grow.
#ifndef GNOMON_ALGORITHMS_SVBSP_IN_OUT_TREE_H
#define GNOMON_ALGORITHMS_SVBSP_IN_OUT_TREE_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/partition/run_options.h"
#include "algorithms/svbsp/balanced_prefix.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

// Cells are encoded in the child links of nodes: OUT, or IN with what tells its caster, an index.
inline constexpr std::int32_t kOutCell = -1;
constexpr std::int32_t in_cell(std::uint32_t index) {
  return -2 - static_cast<std::int32_t>(index);
}
constexpr std::uint32_t index_of_cell(std::int32_t cell) {
  return static_cast<std::uint32_t>(-2 - cell);
}

/// Puts the balanced prefix at the top of a tree. Requires: nothing but the sentinel, whose front
/// child is the root, is in it.
template <LightSpaceModel Space, class Node>
void plant_prefix(Space& space, const PrefixTree& prefix, std::vector<Node>& nodes) {
  if (prefix.nodes.empty()) return;
  const auto link = [](std::int32_t planned) {
    return planned == PrefixNode::kLeaf ? kOutCell : planned + 1;  // after the sentinel
  };
  for (const PrefixNode& planned : prefix.nodes) {
    Node& node = nodes.emplace_back();
    node.plane = space.add_prefix_plane(planned.plane);
    node.front = link(planned.front);
    node.back = link(planned.back);
  }
  nodes[0].front = 1;
}

/// Whether a run has to be given up. A node is smaller than a fragment's loop; the second limit
/// keeps the tree from outgrowing the fragments.
inline bool exceeds(const ShadowLimits& limits, std::size_t fragments, std::uint64_t nodes) {
  constexpr std::uint64_t kMostNodesAFragment = 8;
  return fragments > limits.fragments || nodes / kMostNodesAFragment > limits.fragments;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_IN_OUT_TREE_H
