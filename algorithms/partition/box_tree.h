// SPDX-License-Identifier: LGPL-3.0-or-later
// A bounding-volume hierarchy: boxes sorted into a binary tree by the middles of their longest
// spread, each node with the box of all that is below it. What a search looks for is the caller's
// question: a shaft between two boxes (shadow_volumes/caster_tree.h) or between a point and a light
// (illumination/light_shaft.h).
//
// Guarantee: a search finds every member that it takes, provided that it enters every node above
// that member. The order of the members found depends on the boxes alone.
#ifndef GNOMON_ALGORITHMS_PARTITION_BOX_TREE_H
#define GNOMON_ALGORITHMS_PARTITION_BOX_TREE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/box.h"

namespace gnomon {

class BoxTree {
 public:
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;  // the members below it, in the tree's order
    std::uint32_t right = 0;  // a leaf has 0; else the left child is the next node, and this the
                              // right one
  };

  BoxTree() = default;
  /// The hierarchy of those `members` of `boxes`. `jobs` other than 1: large ones on the threads of
  /// the arena that the caller is in; the hierarchy is the same. Cost: O(n log n).
  BoxTree(std::vector<Box> boxes, std::vector<std::uint32_t> members, unsigned jobs = 1);

  /// Any of the boxes, a member or not.
  const Box& box(std::uint32_t number) const { return boxes_[number]; }
  /// Parents before their children; the root is the first.
  std::span<const Node> nodes() const { return nodes_; }
  std::span<const std::uint32_t> members(const Node& node) const {
    return {order_.data() + node.begin, node.end - node.begin};
  }

  /// Appends the members that `takes(number)` accepts, in the leaves that are reached through
  /// nodes that `enters(node, index)` accepts.
  template <class Enters, class Takes>
  void find(const Enters& enters, const Takes& takes, std::vector<std::uint32_t>& found) const {
    if (nodes_.empty()) return;
    // A left child is taken off as soon as it is put on, so that what stays is one right child a
    // level; the tree halves, and has at most 32 levels.
    std::array<std::uint32_t, 64> stack{};
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t index = stack[--depth];
      const Node& node = nodes_[index];
      if (!enters(node, index)) continue;
      if (node.right != 0) {
        stack[depth++] = node.right;
        stack[depth++] = index + 1;
        continue;
      }
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        if (takes(order_[i])) found.push_back(order_[i]);
      }
    }
  }

 private:
  static constexpr std::uint32_t kLeafSize = 4;
  class Maker;

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_BOX_TREE_H
