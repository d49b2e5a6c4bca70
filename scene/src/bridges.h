// SPDX-License-Identifier: LGPL-3.0-or-later
// Joins holes to the loop, so that one weakly simple ring bounds the polygon: rule 1 of
// polygon_cut.h. Private to scene/src.
#ifndef GNOMON_SCENE_SRC_BRIDGES_H
#define GNOMON_SCENE_SRC_BRIDGES_H

#include <numeric>
#include <optional>

#include "chart.h"

namespace gnomon::scene_detail {

template <class Int>
class Bridges {
 public:
  /// Requires: rings that RingCheck has passed. The loop starts at its smallest key.
  Bridges(const CutInput<Int>& input, const Chart<Int>& chart)
      : chart_(chart), ring_(input.rings[0]) {
    holes_.assign(input.rings.begin() + 1, input.rings.end());
    for (Ring& hole : holes_) start_at_smallest_key(chart, hole);
    std::sort(holes_.begin(), holes_.end(), [&](const Ring& a, const Ring& b) {
      return std::lexicographical_compare(
          a.begin(), a.end(), b.begin(), b.end(),
          [&](std::uint32_t v, std::uint32_t w) { return chart_.key(v) < chart_.key(w); });
    });
  }

  static void start_at_smallest_key(const Chart<Int>& chart, Ring& ring) {
    std::rotate(ring.begin(),
                std::min_element(
                    ring.begin(), ring.end(),
                    [&](std::uint32_t a, std::uint32_t b) { return chart.key(a) < chart.key(b); }),
                ring.end());
  }

  /// Nothing if some hole sees no other ring, which legal rings exclude.
  std::optional<Ring> run() {
    while (!holes_.empty()) {
      if (!join_touching() && !join_by_bridge()) return std::nullopt;
    }
    return std::move(ring_);
  }

 private:
  std::vector<std::size_t> by_key(const Ring& ring) const {
    std::vector<std::size_t> order(ring.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return chart_.key(ring[i]) < chart_.key(ring[j]);
    });
    return order;
  }

  bool join_touching() {
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      const Ring& hole = holes_[h];
      for (const std::size_t j : by_key(hole)) {
        for (std::size_t i = 0; i < ring_.size(); ++i) {
          if (ring_[i] != hole[j]) continue;
          // Of several visits of the ring to this vertex, the one whose angle holds the hole's
          // solid.
          const std::uint32_t p = hole[before(hole, j)], v = hole[j], n = hole[after(hole, j)];
          Int dx = chart_.x(n) + chart_.x(p) - 2 * chart_.x(v);
          Int dy = chart_.y(n) + chart_.y(p) - 2 * chart_.y(v);
          const Sign turn = chart_.turn(p, v, n);  // the solid is to the right of p -> v -> n
          if (turn == Sign::kPositive) {
            dx = -dx;
            dy = -dy;
          } else if (turn == Sign::kZero) {
            dx = chart_.y(n) - chart_.y(v);
            dy = chart_.x(v) - chart_.x(n);
          }
          const Int tx = chart_.x(v) + dx, ty = chart_.y(v) + dy;
          if (!chart_.in_cone(ring_[before(ring_, i)], v, ring_[after(ring_, i)], tx, ty)) continue;
          splice(h, i, j, false);
          return true;
        }
      }
    }
    return false;
  }

  bool join_by_bridge() {
    const std::vector<std::size_t> ring_order = by_key(ring_);
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      const Ring& hole = holes_[h];
      for (const std::size_t j : by_key(hole)) {
        for (const std::size_t i : ring_order) {
          if (!in_cone(ring_, i, hole[j]) || !in_cone(hole, j, ring_[i]) ||
              blocked(ring_[i], hole[j])) {
            continue;
          }
          splice(h, i, j, true);
          return true;
        }
      }
    }
    return false;
  }

  bool in_cone(const Ring& ring, std::size_t i, std::uint32_t target) const {
    return chart_.in_cone(ring[before(ring, i)], ring[i], ring[after(ring, i)], chart_.x(target),
                          chart_.y(target));
  }

  /// The open segment from r to h touches a vertex or crosses an edge.
  bool blocked(std::uint32_t r, std::uint32_t h) const {
    if (blocked_by(ring_, r, h)) return true;
    return std::any_of(holes_.begin(), holes_.end(),
                       [&](const Ring& hole) { return blocked_by(hole, r, h); });
  }
  bool blocked_by(const Ring& ring, std::uint32_t r, std::uint32_t h) const {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t a = ring[k], b = ring[after(ring, k)];
      if (chart_.inside_segment(r, h, a) || chart_.cross_properly(r, h, a, b)) return true;
    }
    return false;
  }

  /// Puts hole h into the ring behind its i-th vertex, starting at its own j-th.
  void splice(std::size_t h, std::size_t i, std::size_t j, bool bridge) {
    Ring chain = std::move(holes_[h]);
    holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(h));
    std::rotate(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(j), chain.end());
    const std::uint32_t from = ring_[i], to = chain[0];
    if (bridge) {
      chain.push_back(to);
      chain.push_back(from);
    } else {
      chain.erase(chain.begin());
      chain.push_back(to);
    }
    ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(i) + 1, chain.begin(), chain.end());
  }

  const Chart<Int>& chart_;
  Ring ring_;
  std::vector<Ring> holes_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_SRC_BRIDGES_H
