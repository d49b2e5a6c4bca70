// SPDX-License-Identifier: LGPL-3.0-or-later
// The balanced top of the merged trees: a k-d split of space by axis planes, planned for the
// receivers, since they are what goes down the finished trees. Where no receiver is, no volume
// need be.
//
// A heuristic on rounded boxes: whatever it plans, the trees answer the same, provided that every
// receiver is inside its box.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_BALANCED_PREFIX_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_BALANCED_PREFIX_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/box.h"

namespace gnomon {

struct SpacePrefix {
  static constexpr std::int32_t kLeaf = -1;
  static constexpr std::int32_t kUnused = -2;  // a leaf without receivers
  struct Node {
    int axis = 0;
    double value = 0;                          // a multiple of 2^-kBits
    std::int32_t front = kLeaf, back = kLeaf;  // the front is where the coordinate is larger
  };
  static constexpr int kBits = 20;
  std::vector<Node> nodes;  // nodes[0] is the root; none: a single leaf
};

/// `receivers`: boxes in fractions of the grid's extent. Splits only while that pays and a leaf has
/// more than `leaf_size` receivers.
SpacePrefix plan_space_prefix(std::span<const Box> receivers, std::uint32_t leaf_size);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_BALANCED_PREFIX_H
