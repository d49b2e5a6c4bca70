// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact predicates of the plane over the vertices of a CutInput.
#ifndef GNOMON_SCENE_PREPARE_CHART_H
#define GNOMON_SCENE_PREPARE_CHART_H

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "scene/prepare/polygon_cut.h"

namespace gnomon::scene_detail {

using Ring = std::vector<std::uint32_t>;

inline std::size_t after(const Ring& ring, std::size_t i) {
  return i + 1 == ring.size() ? 0 : i + 1;
}
inline std::size_t before(const Ring& ring, std::size_t i) {
  return i == 0 ? ring.size() - 1 : i - 1;
}

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

template <class Int>
class Chart {
 public:
  explicit Chart(const CutInput<Int>& input) : input_(input) {}

  std::size_t size() const { return input_.x.size(); }
  bool stopped() const { return input_.stopped(); }
  const Int& x(std::uint32_t v) const { return input_.x[v]; }
  const Int& y(std::uint32_t v) const { return input_.y[v]; }
  std::uint32_t key(std::uint32_t v) const { return input_.key[v]; }

  /// Positive: a, b, c turn left.
  Sign turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return turn_to(a, b, x(c), y(c));
  }
  Sign turn_to(std::uint32_t a, std::uint32_t b, const Int& cx, const Int& cy) const {
    const Int left = (x(b) - x(a)) * (cy - y(a));
    const Int right = (y(b) - y(a)) * (cx - x(a));
    return left > right ? Sign::kPositive : left < right ? Sign::kNegative : Sign::kZero;
  }
  bool same_place(std::uint32_t a, std::uint32_t b) const {
    return a == b || (x(a) == x(b) && y(a) == y(b));
  }
  /// Is c in the closed box of a and b?
  bool in_box(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return std::min(x(a), x(b)) <= x(c) && x(c) <= std::max(x(a), x(b)) &&
           std::min(y(a), y(b)) <= y(c) && y(c) <= std::max(y(a), y(b));
  }
  bool boxes_meet(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return std::min(x(a), x(b)) <= std::max(x(c), x(d)) &&
           std::min(x(c), x(d)) <= std::max(x(a), x(b)) &&
           std::min(y(a), y(b)) <= std::max(y(c), y(d)) &&
           std::min(y(c), y(d)) <= std::max(y(a), y(b));
  }
  /// c strictly between a and b on their segment.
  bool inside_segment(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return in_box(a, b, c) && !same_place(a, c) && !same_place(b, c) &&
           turn(a, b, c) == Sign::kZero;
  }
  /// The open segments cross in one point.
  bool cross_properly(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return boxes_meet(a, b, c, d) && turn(a, b, c) * turn(a, b, d) == Sign::kNegative &&
           turn(c, d, a) * turn(c, d, b) == Sign::kNegative;
  }
  /// The closed segments have a point in common.
  bool meet(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    if (!boxes_meet(a, b, c, d)) return false;
    const Sign abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
    if (abc * abd == Sign::kNegative && cda * cdb == Sign::kNegative) return true;
    return (abc == Sign::kZero && in_box(a, b, c)) || (abd == Sign::kZero && in_box(a, b, d)) ||
           (cda == Sign::kZero && in_box(c, d, a)) || (cdb == Sign::kZero && in_box(c, d, b));
  }
  /// The target lies strictly inside the angle to the left of previous -> corner -> next.
  bool in_cone(std::uint32_t previous, std::uint32_t corner, std::uint32_t next, const Int& tx,
               const Int& ty) const {
    const bool left_of_next = turn_to(corner, next, tx, ty) == Sign::kPositive;
    const bool left_of_previous = turn_to(previous, corner, tx, ty) == Sign::kPositive;
    // Up to 180 degrees both must hold; beyond, one is enough.
    return turn(previous, corner, next) != Sign::kNegative ? left_of_next && left_of_previous
                                                           : left_of_next || left_of_previous;
  }
  /// Twice the signed area.
  Int area(const Ring& ring) const {
    Int sum = 0;
    for (std::size_t i = 2; i < ring.size(); ++i) {
      const std::uint32_t a = ring[0], b = ring[i - 1], c = ring[i];
      sum += (x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a));
    }
    return sum;
  }

  /// A ray along x from the middle of (a, b), which is not on the edge (p, q), meets that edge.
  bool passes_middle(std::uint32_t p, std::uint32_t q, std::uint32_t a, std::uint32_t b) const {
    const Int mx = x(a) + x(b), my = y(a) + y(b);  // doubled
    const Int px = 2 * x(p), py = 2 * y(p), qx = 2 * x(q), qy = 2 * y(q);
    if ((py > my) == (qy > my)) return false;
    const Int side = (qx - px) * (my - py) - (qy - py) * (mx - px);
    return (side > 0) == (qy > py);
  }

 private:
  const CutInput<Int>& input_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_CHART_H
