// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of boxes, to find those that are near something without looking at all of them.
//
// Exactness: compares coordinates as they are; who asks adds what they may be off by.
#ifndef GNOMON_ORACLE_GEOMETRY_BOX_TREE_H
#define GNOMON_ORACLE_GEOMETRY_BOX_TREE_H

#include <cstdint>
#include <vector>

#include "oracle/geometry/planar_loop.h"

namespace gnomon::oracle {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<PlanarBox> boxes);

  /// Calls for the index of every box that meets one, boundaries included.
  template <class Visit>
  void meeting(const PlanarBox& box, const Visit& visit) const {
    if (!nodes_.empty()) meeting(0, box, visit);
  }

  /// The least of `most` and all values: `value(index)`, of which `bound(box)` is a lower bound for
  /// every index whose box is within that box.
  template <class Bound, class Value>
  double least(double most, const Bound& bound, const Value& value) const {
    if (!nodes_.empty() && bound(nodes_[0].box) < most) least(0, most, bound, value);
    return most;
  }

 private:
  struct Node {
    PlanarBox box;
    std::uint32_t first = 0, last = 0;  // of the order
    std::uint32_t second = 0;           // child, the other one follows its parent; 0: a leaf
  };

  void grow(std::uint32_t first, std::uint32_t last);

  template <class Visit>
  void meeting(std::uint32_t at, const PlanarBox& box, const Visit& visit) const {
    const Node& node = nodes_[at];
    if (!box.meets(node.box)) return;
    if (node.second != 0) {
      meeting(at + 1, box, visit);
      meeting(node.second, box, visit);
      return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      if (box.meets(boxes_[order_[i]])) visit(order_[i]);
    }
  }

  template <class Bound, class Value>
  void least(std::uint32_t at, double& most, const Bound& bound, const Value& value) const {
    const Node& node = nodes_[at];
    if (node.second == 0) {
      for (std::uint32_t i = node.first; i < node.last; ++i) {
        const double own = value(order_[i]);
        if (own < most) most = own;
      }
      return;
    }
    // The more promising child first.
    std::uint32_t near = at + 1, far = node.second;
    double near_bound = bound(nodes_[near].box), far_bound = bound(nodes_[far].box);
    if (far_bound < near_bound) {
      std::swap(near, far);
      std::swap(near_bound, far_bound);
    }
    if (near_bound < most) least(near, most, bound, value);
    if (far_bound < most) least(far, most, bound, value);
  }

  std::vector<PlanarBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;  // a parent before its children
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_BOX_TREE_H
