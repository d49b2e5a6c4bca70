// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether a fragment is part of the answer: all are (docs/semantics.md, "A result"), unless the
// rules ask about its shape.
#ifndef GNOMON_ALGORITHMS_PARTITION_FRAGMENT_STAYS_H
#define GNOMON_ALGORITHMS_PARTITION_FRAGMENT_STAYS_H

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/rules.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// What the rules say of a loop's shape. Requires: they ask about it.
template <MeasuredSpace Space>
bool shape_stays(const Space& space, const LoopView<typename Space::Vertex>& loop,
                 const Rules& rules) {
  std::vector<std::array<double, 3>> corners;
  bool is_input = true;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const std::array<Ball, 3> ball = space.position(loop.corner(i));
    corners.push_back({ball[0].middle, ball[1].middle, ball[2].middle});
    is_input = is_input && loop.vertices[i].source != kMadeVertex;
  }
  return rules.fragment_stays({corners, is_input});
}

/// Costs one comparison under the rules of the definition: positions are made only for others.
template <MeasuredSpace Space>
bool fragment_stays(const Space& space, const LoopView<typename Space::Vertex>& loop,
                    const Rules& rules) {
  if (rules.fragment_stays == nullptr) [[likely]]
    return true;
  return shape_stays(space, loop, rules);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_FRAGMENT_STAYS_H
