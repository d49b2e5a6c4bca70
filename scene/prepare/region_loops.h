// SPDX-License-Identifier: LGPL-3.0-or-later
// The connected components of a polygon whose loop and holes may touch themselves and each other:
// rule 1 of polygon_cut.h.
//
// Where two rings run along one edge in opposite directions both edges cancel. What is left is
// traced anew: coming into a vertex, the trace leaves by the first edge clockwise from where it
// came, so that the angle between them, to the left, is one undivided angle of the region. So holes
// that touch the loop or each other become one ring with it, and a polygon that touching holes cut
// apart falls into components, each bounded by one ring and the holes inside. A ring may visit a
// vertex more than once, but always with another angle of the region.
#ifndef GNOMON_SCENE_PREPARE_REGION_LOOPS_H
#define GNOMON_SCENE_PREPARE_REGION_LOOPS_H

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "scene/prepare/edge_index.h"

namespace gnomon::scene_detail {

struct RegionComponent {
  Ring loop;                // counter-clockwise
  std::vector<Ring> holes;  // clockwise, touching neither the loop nor each other
};

template <class Int>
void start_at_smallest_key(const Chart<Int>& chart, Ring& ring) {
  const auto by_key = [&](std::uint32_t a, std::uint32_t b) { return chart.key(a) < chart.key(b); };
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), by_key), ring.end());
}

/// b comes before c when turning clockwise about v from the direction of a. None has that
/// direction.
template <class Int>
bool clockwise_before(const Chart<Int>& chart, std::uint32_t v, std::uint32_t a, std::uint32_t b,
                      std::uint32_t c) {
  const auto half = [&](std::uint32_t w) {
    switch (chart.turn(v, a, w)) {
      case Sign::kNegative:
        return 0;
      case Sign::kZero:
        return 1;
      default:
        return 2;
    }
  };
  const int hb = half(b), hc = half(c);
  return hb != hc ? hb < hc : chart.turn(v, b, c) == Sign::kNegative;
}

template <class Int>
class RegionTracer {
 public:
  /// Requires: edges() of a RingCheck that has passed: the loop counter-clockwise, holes clockwise.
  RegionTracer(const Chart<Int>& chart, const std::vector<RingEdge>& edges)
      : chart_(chart), rings_(edges) {}

  tl::expected<std::vector<RegionComponent>, CutProblem> run() {
    if (auto problem = cancel()) return tl::unexpected(std::move(*problem));
    while (!edges_.empty()) {
      if (auto problem = trace()) return tl::unexpected(std::move(*problem));
    }
    return give_holes_to_loops();
  }

 private:
  CutProblem overlap(const Ring& ring) const {
    return {0,
            fmt::format(
                "runs round the same area more than once, or the wrong way round, near vertex {}",
                chart_.key(ring[0]))};
  }

  /// Outer rings first, then inner ones.
  EdgeIndex<Int> index_of_traced() const {
    std::vector<RingEdge> edges;
    std::uint32_t r = 0;
    const auto add = [&](const Ring& ring) {
      for (std::uint32_t i = 0; i < ring.size(); ++i) {
        edges.push_back({ring[i], ring[after(ring, i)], r, i});
      }
      ++r;
    };
    for (const RegionComponent& component : outer_) add(component.loop);
    for (const Ring& hole : holes_) add(hole);
    return EdgeIndex<Int>(chart_, std::move(edges));
  }

  /// The region lies to the left once and never twice: a ring that bounds it from outside is inside
  /// of as many outer rings as inner ones, an inner ring of one outer ring more. It belongs to the
  /// smallest of these.
  tl::expected<std::vector<RegionComponent>, CutProblem> give_holes_to_loops() {
    if (holes_.empty() && outer_.size() <= 1) return std::move(outer_);
    const EdgeIndex<Int> index = index_of_traced();
    const auto outer_count = static_cast<std::uint32_t>(outer_.size());
    std::vector<Int> areas;
    for (const RegionComponent& component : outer_) areas.push_back(chart_.area(component.loop));
    for (std::uint32_t r = 0; r < outer_count + holes_.size(); ++r) {
      const bool is_hole = r >= outer_count;
      const Ring& ring = is_hole ? holes_[r - outer_count] : outer_[r].loop;
      std::size_t outer = 0, inner = 0;
      std::uint32_t owner = outer_count;
      for (const std::uint32_t around : index.rings_around(ring[0], ring[1])) {
        if (around == r) continue;
        ++(around < outer_count ? outer : inner);
        if (around >= outer_count) continue;
        if (owner == outer_count || areas[around] < areas[owner]) owner = around;
      }
      if (outer != inner + (is_hole ? 1 : 0)) return tl::unexpected(overlap(ring));
      if (is_hole) owners_.push_back(owner);
    }
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      outer_[owners_[h]].holes.push_back(std::move(holes_[h]));
    }
    return std::move(outer_);
  }

  std::optional<CutProblem> cancel() {
    for (const RingEdge& named : rings_) {
      const DirectedEdge edge{named.a, named.b};
      if (edges_.erase({edge.second, edge.first}) == 1) continue;
      if (!edges_.insert(edge).second) {
        return CutProblem{named.ring, fmt::format("runs along the edge {}-{} twice",
                                                  chart_.key(edge.first), chart_.key(edge.second))};
      }
    }
    for (const auto& [a, b] : edges_) {
      around_[a].push_back({b, true});
      around_[b].push_back({a, false});
    }
    return std::nullopt;
  }

  std::optional<CutProblem> trace() {
    const auto [start, second] = *edges_.begin();
    Ring ring;
    for (std::uint32_t a = start, b = second; edges_.erase({a, b}) == 1;) {
      ring.push_back(a);
      const Spoke* next = nullptr;
      for (const Spoke& spoke : around_[b]) {
        if (spoke.end == a) continue;
        if (next == nullptr || clockwise_before(chart_, b, a, spoke.end, next->end)) next = &spoke;
      }
      if (next == nullptr || !next->leaves) {
        return CutProblem{0, fmt::format("crosses itself at vertex {}", chart_.key(b))};
      }
      a = std::exchange(b, next->end);
    }
    start_at_smallest_key(chart_, ring);
    if (chart_.area(ring) > 0) {
      outer_.push_back({std::move(ring), {}});
    } else {
      holes_.push_back(std::move(ring));
    }
    return std::nullopt;
  }

  struct Spoke {
    std::uint32_t end;
    bool leaves;  // the edge runs from the vertex to the end
  };

  const Chart<Int>& chart_;
  const std::vector<RingEdge>& rings_;
  std::set<DirectedEdge> edges_;
  std::map<std::uint32_t, std::vector<Spoke>> around_;
  std::vector<RegionComponent> outer_;
  std::vector<Ring> holes_;
  std::vector<std::uint32_t> owners_;  // of holes_: outer rings
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_REGION_LOOPS_H
