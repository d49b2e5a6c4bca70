// SPDX-License-Identifier: LGPL-3.0-or-later
// Sub-objects in order of depth as a light sees them (Crow 1977, second class: "priority order"),
// from pairs of them one of which may hide some of the other. Where such pairs make a ring there is
// no order: all that are on rings with each other are one group.
#ifndef GNOMON_ALGORITHMS_BLOTS_HIDING_ORDER_H
#define GNOMON_ALGORITHMS_BLOTS_HIDING_ORDER_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// Something of `nearer` is before something of `farther`, as seen from the light.
struct HidingPair {
  std::uint32_t nearer = 0, farther = 0;
};

struct HidingOrder {
  std::vector<std::uint32_t> members;  // of all groups, front to back; ascending in a group
  std::vector<std::uint32_t> start;    // of each group in `members`, and the end of the last

  std::size_t groups() const { return start.size() - 1; }
  std::span<const std::uint32_t> group(std::size_t i) const {
    return {members.data() + start[i], start[i + 1] - start[i]};
  }
};

/// Groups of the things 0, ..., count - 1: no member of a later group hides one of an earlier
/// group. Cost: linear in things and pairs, without recursion.
HidingOrder hiding_order(std::uint32_t count, std::span<const HidingPair> pairs);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BLOTS_HIDING_ORDER_H
