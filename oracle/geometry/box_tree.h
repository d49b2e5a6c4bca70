// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of boxes of a plane or of space, to find those that are near something without looking at
// all of them.
//
// Exactness: compares coordinates as they are; who asks adds what they may be off by.
#ifndef GNOMON_ORACLE_GEOMETRY_BOX_TREE_H
#define GNOMON_ORACLE_GEOMETRY_BOX_TREE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "oracle/geometry/planar_loop.h"

namespace gnomon::oracle {

struct SpaceBox {
  std::array<double, 3> low, high;
  bool meets(const SpaceBox& other) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (low[k] > other.high[k] || other.low[k] > high[k]) return false;
    }
    return true;
  }
};

/// The smallest box that holds both.
inline PlanarBox joined(const PlanarBox& a, const PlanarBox& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}
inline SpaceBox joined(SpaceBox a, const SpaceBox& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    a.low[k] = std::min(a.low[k], b.low[k]);
    a.high[k] = std::max(a.high[k], b.high[k]);
  }
  return a;
}
/// The axis along which it is longest.
inline std::size_t longest_axis(const PlanarBox& box) {
  return box.high.x - box.low.x >= box.high.y - box.low.y ? 0 : 1;
}
inline std::size_t longest_axis(const SpaceBox& box) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (box.high[k] - box.low[k] > box.high[longest] - box.low[longest]) longest = k;
  }
  return longest;
}
/// Twice the coordinate of its middle.
inline long double doubled_middle(const PlanarBox& box, std::size_t axis) {
  return axis == 0 ? box.low.x + box.high.x : box.low.y + box.high.y;
}
inline double doubled_middle(const SpaceBox& box, std::size_t axis) {
  return box.low[axis] + box.high[axis];
}

template <class Box>
class BoxTreeOf {
 public:
  BoxTreeOf() = default;
  explicit BoxTreeOf(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes_.empty()) grow(0, static_cast<std::uint32_t>(boxes_.size()));
  }

  const Box& operator[](std::uint32_t index) const { return boxes_[index]; }

  /// Calls for the index of every box that meets one, boundaries included.
  template <class Visit>
  void meeting(const Box& box, const Visit& visit) const {
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
    Box box;
    std::uint32_t first = 0, last = 0;  // of the order
    std::uint32_t second = 0;           // child, the other one follows its parent; 0: a leaf
  };

  void grow(std::uint32_t first, std::uint32_t last) {
    constexpr std::uint32_t kLeaf = 6;
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    Box box = boxes_[order_[first]];
    for (std::uint32_t i = first + 1; i < last; ++i) box = joined(box, boxes_[order_[i]]);
    nodes_.push_back({box, first, last, 0});
    if (last - first <= kLeaf) return;
    const std::size_t axis = longest_axis(box);
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return doubled_middle(boxes_[a], axis) < doubled_middle(boxes_[b], axis);
                     });
    grow(first, middle);
    nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
    grow(middle, last);
  }

  template <class Visit>
  void meeting(std::uint32_t at, const Box& box, const Visit& visit) const {
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

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;  // a parent before its children
};

using BoxTree = BoxTreeOf<PlanarBox>;
using SpaceTree = BoxTreeOf<SpaceBox>;

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_BOX_TREE_H
