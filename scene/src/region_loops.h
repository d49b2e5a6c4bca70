// SPDX-License-Identifier: LGPL-3.0-or-later
// The connected components of a polygon with holes that may touch: rule 1 of polygon_cut.h. Private
// to scene/src.
//
// Where two rings run along one edge in opposite directions both edges cancel. What is left is
// traced anew: coming into a vertex, the trace leaves by the first edge clockwise from where it
// came, so that the angle between them, to the left, is one undivided angle of the region. So holes
// that touch the loop or each other become one ring with it, and a polygon that touching holes cut
// apart falls into components, each bounded by one ring and the holes inside. A ring may visit a
// vertex more than once, but always with another angle of the region.
#ifndef GNOMON_SCENE_SRC_REGION_LOOPS_H
#define GNOMON_SCENE_SRC_REGION_LOOPS_H

#include <map>
#include <set>
#include <utility>

#include "chart.h"

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

/// Requires: rings that RingCheck has passed: the loop counter-clockwise, holes clockwise.
template <class Int>
std::vector<RegionComponent> region_components(const Chart<Int>& chart,
                                               const std::vector<Ring>& rings) {
  if (rings.size() == 1) return {{rings[0], {}}};

  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::pair edge{ring[i], ring[after(ring, i)]};
      if (edges.erase({edge.second, edge.first}) == 0) edges.insert(edge);
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> out;
  for (const auto& [a, b] : edges) out[a].push_back(b);

  std::vector<RegionComponent> components;
  std::vector<Ring> holes;
  while (!edges.empty()) {
    const auto [start, second] = *edges.begin();
    Ring ring;
    for (std::uint32_t a = start, b = second; edges.erase({a, b}) == 1;) {
      ring.push_back(a);
      const std::vector<std::uint32_t>& targets = out[b];
      std::uint32_t next = targets[0];
      for (const std::uint32_t target : targets) {
        if (target != next && clockwise_before(chart, b, a, target, next)) next = target;
      }
      a = std::exchange(b, next);
    }
    start_at_smallest_key(chart, ring);
    if (chart.area(ring) > 0) {
      components.push_back({std::move(ring), {}});
    } else {
      holes.push_back(std::move(ring));
    }
  }
  for (Ring& hole : holes) {
    RegionComponent* owner = nullptr;
    for (RegionComponent& component : components) {
      if (!chart.middle_is_inside(component.loop, hole[0], hole[1])) continue;
      if (owner == nullptr || chart.area(component.loop) < chart.area(owner->loop))
        owner = &component;
    }
    if (owner != nullptr) owner->holes.push_back(std::move(hole));
  }
  return components;
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_SRC_REGION_LOOPS_H
