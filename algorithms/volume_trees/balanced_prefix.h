// SPDX-License-Identifier: LGPL-3.0-or-later
// The balanced top of the penumbra and umbra trees: a k-d split of space by axis planes. It is
// planned for the receivers, because they go down the finished trees.
//
// This is a heuristic on rounded boxes: the trees answer the same whatever it plans, provided that
// every receiver is inside its box.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_BALANCED_PREFIX_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_BALANCED_PREFIX_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/box.h"
#include "algorithms/partition/kd_tree.h"

namespace gnomon {

struct SpacePrefix {
  static constexpr std::int32_t kLeaf = -1;
  struct Node : KdSplit {
    std::int32_t front = kLeaf, back = kLeaf;
  };
  std::vector<Node> nodes;  // nodes[0] is the root; none: a single leaf
};

/// `receivers`: boxes in fractions of the grid's extent. Splits only while that pays and a leaf has
/// more than `leaf_size` receivers.
SpacePrefix plan_space_prefix(std::span<const Box> receivers, std::uint32_t leaf_size);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_BALANCED_PREFIX_H
