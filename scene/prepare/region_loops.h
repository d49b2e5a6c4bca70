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

#include "scene/prepare/chart.h"

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
  /// Requires: rings that RingCheck has passed: the loop counter-clockwise, holes clockwise.
  RegionTracer(const Chart<Int>& chart, const std::vector<Ring>& rings)
      : chart_(chart), rings_(rings) {}

  tl::expected<std::vector<RegionComponent>, CutProblem> run() {
    if (auto problem = cancel()) return tl::unexpected(std::move(*problem));
    while (!edges_.empty()) {
      if (auto problem = trace()) return tl::unexpected(std::move(*problem));
    }
    // The region lies to the left once and never twice: a ring that bounds it from outside is
    // inside of as many outer rings as inner ones, an inner ring of one outer ring more.
    for (std::size_t i = 0; i < outer_.size(); ++i) {
      if (count(outer_, outer_[i].loop, i) != count(holes_, outer_[i].loop))
        return tl::unexpected(overlap(outer_[i].loop));
    }
    for (std::size_t i = 0; i < holes_.size(); ++i) {
      if (count(outer_, holes_[i]) != count(holes_, holes_[i], i) + 1)
        return tl::unexpected(overlap(holes_[i]));
    }
    for (Ring& hole : holes_) {
      RegionComponent* owner = nullptr;
      for (RegionComponent& component : outer_) {
        if (!contains(component.loop, hole)) continue;
        if (owner == nullptr || chart_.area(component.loop) < chart_.area(owner->loop))
          owner = &component;
      }
      owner->holes.push_back(std::move(hole));
    }
    return std::move(outer_);
  }

 private:
  CutProblem overlap(const Ring& ring) const {
    return {0,
            fmt::format(
                "runs round the same area more than once, or the wrong way round, near vertex {}",
                chart_.key(ring[0]))};
  }
  static const Ring& ring_of(const RegionComponent& component) { return component.loop; }
  static const Ring& ring_of(const Ring& ring) { return ring; }
  bool contains(const Ring& outer, const Ring& inner) const {
    return chart_.middle_is_inside(outer, inner[0], inner[1]);
  }
  template <class Rings>
  std::size_t count(const Rings& rings, const Ring& inner,
                    std::size_t except = ~std::size_t{0}) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < rings.size(); ++i)
      n += i != except && contains(ring_of(rings[i]), inner) ? 1 : 0;
    return n;
  }

  std::optional<CutProblem> cancel() {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      for (const DirectedEdge& edge : edges_without_hairs(rings_[r])) {
        if (edges_.erase({edge.second, edge.first}) == 1) continue;
        if (!edges_.insert(edge).second) {
          return CutProblem{r, fmt::format("runs along the edge {}-{} twice",
                                           chart_.key(edge.first), chart_.key(edge.second))};
        }
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
  const std::vector<Ring>& rings_;
  std::set<DirectedEdge> edges_;
  std::map<std::uint32_t, std::vector<Spoke>> around_;
  std::vector<RegionComponent> outer_;
  std::vector<Ring> holes_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_REGION_LOOPS_H
