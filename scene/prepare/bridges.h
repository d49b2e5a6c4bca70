// SPDX-License-Identifier: LGPL-3.0-or-later
// Joins holes to the loop, so that one weakly simple ring bounds the polygon: rule 1 of
// polygon_cut.h.
#ifndef GNOMON_SCENE_PREPARE_BRIDGES_H
#define GNOMON_SCENE_PREPARE_BRIDGES_H

#include <numeric>
#include <optional>

#include "scene/prepare/region_loops.h"

namespace gnomon::scene_detail {

template <class Int>
class Bridges {
 public:
  Bridges(const Chart<Int>& chart, RegionComponent component)
      : chart_(chart), ring_(std::move(component.loop)), holes_(std::move(component.holes)) {
    start_at_smallest_key(chart_, ring_);
    for (Ring& hole : holes_) start_at_smallest_key(chart_, hole);
    std::sort(holes_.begin(), holes_.end(), [&](const Ring& a, const Ring& b) {
      return std::lexicographical_compare(
          a.begin(), a.end(), b.begin(), b.end(),
          [&](std::uint32_t v, std::uint32_t w) { return chart_.key(v) < chart_.key(w); });
    });
  }

  /// Nothing if some hole sees no other ring, which legal rings exclude.
  std::optional<Ring> run() {
    while (!holes_.empty()) {
      if (!join_by_bridge()) return std::nullopt;
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
          splice(h, i, j);
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
  void splice(std::size_t h, std::size_t i, std::size_t j) {
    Ring chain = std::move(holes_[h]);
    holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(h));
    std::rotate(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(j), chain.end());
    chain.push_back(chain[0]);
    chain.push_back(ring_[i]);
    ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(i) + 1, chain.begin(), chain.end());
  }

  const Chart<Int>& chart_;
  Ring ring_;
  std::vector<Ring> holes_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_BRIDGES_H
