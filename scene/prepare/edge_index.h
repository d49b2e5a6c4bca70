// SPDX-License-Identifier: LGPL-3.0-or-later
// Which edges of a polygon's rings come near an edge or a point, and which rings run round a point:
// found by a tree of boxes, decided by the exact predicates of the chart.
#ifndef GNOMON_SCENE_PREPARE_EDGE_INDEX_H
#define GNOMON_SCENE_PREPARE_EDGE_INDEX_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "scene/geometry/box_tree.h"
#include "scene/prepare/chart.h"

namespace gnomon::scene_detail {

/// An edge of a ring, or a piece of one between vertices that lie in it.
struct RingEdge {
  std::uint32_t a = 0, b = 0;  // runs from a to b
  std::uint32_t ring = 0;      // of the polygon: 0 is the loop
  std::uint32_t whole = 0;     // the edge of the ring that it is a piece of
};

/// Requires: less than 2^32 edges. Cost: O(n log n); of a question O(log n) and what is found,
/// unless very many boxes overlap.
template <class Int>
class EdgeIndex {
 public:
  EdgeIndex(const Chart<Int>& chart, std::vector<RingEdge> edges)
      : chart_(chart), edges_(std::move(edges)), tree_(boxes()) {}

  const std::vector<RingEdge>& edges() const { return edges_; }

  /// Calls f(i) for every edge i whose box meets that of (a, b), and some more. No order.
  template <class F>
  void for_each_near(std::uint32_t a, std::uint32_t b, const F& f) const {
    tree_.for_each_that_meets(box_of(a, b), f);
  }

  /// The rings that run round the middle of (a, b) an odd number of times, ascending. Rings on
  /// which that point lies say nothing.
  std::vector<std::uint32_t> rings_around(std::uint32_t a, std::uint32_t b) const {
    Box ray = Box::empty();
    const double y = (y_of(a) + y_of(b)) / 2;
    ray.add(0, (x_of(a) + x_of(b)) / 2, std::numeric_limits<double>::infinity());
    ray.add(1, y, y);
    ray.add(2, 0, 0);
    std::vector<std::uint32_t> met;
    tree_.for_each_that_meets(ray, [&](std::uint32_t i) {
      const RingEdge& edge = edges_[i];
      if (chart_.passes_middle(edge.a, edge.b, a, b)) met.push_back(edge.ring);
    });
    std::sort(met.begin(), met.end());
    std::vector<std::uint32_t> odd;
    for (std::size_t i = 0, end = 0; i < met.size(); i = end) {
      while (end < met.size() && met[end] == met[i]) ++end;
      if ((end - i) % 2 != 0) odd.push_back(met[i]);
    }
    return odd;
  }

 private:
  // Seen from the first vertex: boxes are floats, and the polygon may be small in a large scene.
  double x_of(std::uint32_t v) const { return number(Int(chart_.x(v) - chart_.x(0))); }
  double y_of(std::uint32_t v) const { return number(Int(chart_.y(v) - chart_.y(0))); }
  /// Rounding to double keeps order, and boxes round outwards from there.
  static double number(const Int& value) {
    if constexpr (std::is_same_v<Int, mpz_class>) {
      return value.get_d();
    } else {
      return static_cast<double>(value);
    }
  }
  Box box_of(std::uint32_t a, std::uint32_t b) const {
    Box box = Box::empty();
    for (const std::uint32_t v : {a, b}) {
      const double x = x_of(v), y = y_of(v);
      box.add(0, x, x);
      box.add(1, y, y);
    }
    box.add(2, 0, 0);
    return box;
  }
  std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    boxes.reserve(edges_.size());
    for (const RingEdge& edge : edges_) boxes.push_back(box_of(edge.a, edge.b));
    return boxes;
  }

  const Chart<Int>& chart_;
  std::vector<RingEdge> edges_;
  BoxTree tree_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_EDGE_INDEX_H
