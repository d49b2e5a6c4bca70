// SPDX-License-Identifier: LGPL-3.0-or-later
// A tree of boxes: which of many boxes meet a given one.
#ifndef GNOMON_SCENE_GEOMETRY_BOX_TREE_H
#define GNOMON_SCENE_GEOMETRY_BOX_TREE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace gnomon::scene_detail {

struct Box {
  std::array<float, 3> low, high;

  static Box empty() {
    constexpr float kMost = std::numeric_limits<float>::infinity();
    return {{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}};
  }
  /// Rounds outwards, so that boxes that meet exactly also meet here.
  void add(int axis, double from, double to) {
    constexpr float kMost = std::numeric_limits<float>::infinity();
    const auto k = static_cast<std::size_t>(axis);
    low[k] = std::min(low[k], std::nextafter(to_float(from), -kMost));
    high[k] = std::max(high[k], std::nextafter(to_float(to), kMost));
  }
  void add(const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  static float to_float(double value) {
    constexpr double kGreatest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -kGreatest, kGreatest));
  }
  bool meets(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
  }
};

class BoxTree {
 public:
  /// The boxes are not kept. Cost: O(n log n).
  explicit BoxTree(const std::vector<Box>& boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(2 * (boxes.size() / kLeaf + 1));
    if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
    sorted_.reserve(boxes.size());
    for (const std::uint32_t i : order_) sorted_.push_back(boxes[i]);
  }

  /// Calls f(i) for every box i that meets this one.
  template <class F>
  void for_each_that_meets(const Box& box, const F& f) const {
    // A node's children follow it: a node that is missed is jumped over.
    for (std::uint32_t at = 0; at < nodes_.size();) {
      const Node& node = nodes_[at];
      if (!node.box.meets(box)) {
        at = node.next;
        continue;
      }
      for (std::uint32_t k = node.begin; k < node.end; ++k) {
        if (sorted_[k].meets(box)) f(order_[k]);
      }
      ++at;
    }
  }

 private:
  static constexpr std::uint32_t kLeaf = 8;
  struct Node {
    Box box;
    std::uint32_t begin, end;  // boxes of a leaf; none of an inner node
    std::uint32_t next;        // the node behind all below this one
  };

  void build(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end) {
    const std::size_t self = nodes_.size();
    Node node{Box::empty(), begin, begin, 0};
    for (std::uint32_t k = begin; k < end; ++k) node.box.add(boxes[order_[k]]);
    if (end - begin <= kLeaf) node.end = end;
    nodes_.push_back(node);
    if (end - begin > kLeaf) {
      std::size_t axis = 0;
      for (std::size_t k = 1; k < 3; ++k) {
        if (node.box.high[k] - node.box.low[k] > node.box.high[axis] - node.box.low[axis]) axis = k;
      }
      const std::uint32_t middle = begin + (end - begin) / 2;
      std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                       [&](std::uint32_t a, std::uint32_t b) {
                         const float at_a = boxes[a].low[axis] + boxes[a].high[axis],
                                     at_b = boxes[b].low[axis] + boxes[b].high[axis];
                         return at_a < at_b || (at_a == at_b && a < b);
                       });
      build(boxes, begin, middle);
      build(boxes, middle, end);
    }
    nodes_[self].next = static_cast<std::uint32_t>(nodes_.size());
  }

  std::vector<std::uint32_t> order_;
  std::vector<Box> sorted_;
  std::vector<Node> nodes_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GEOMETRY_BOX_TREE_H
