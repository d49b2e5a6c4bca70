// SPDX-License-Identifier: LGPL-3.0-or-later
// A hierarchy of boxes, eight to a group, and the shaft between a receiver and a light
// (shadow_volumes/caster_tree.h), which is tried against a group at once.
//
// Guarantee: what a shaft is said to miss, it misses. Boxes and shaft are in single precision,
// wider by more than its roundings: coordinates are fractions of the grid's extent, at most 1, so
// that a place is off by 2^-25, a tangent's value, of two products of numbers below 1, by less than
// 2^-21, and both are given more room.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_BOX_GROUPS_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_BOX_GROUPS_H

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/area_contour/four_doubles.h"
#include "algorithms/partition/box.h"
#include "algorithms/partition/box_tree.h"

namespace gnomon::area_contour {

/// Boxes of eight groups, or of eight members; what fills up the last lanes meets nothing.
struct alignas(32) BoxGroup {
  static constexpr std::uint32_t kSize = 8;
  static constexpr std::size_t kHigh = 3;

  float ends[6][kSize];  // the least coordinates, kHigh on the greatest
  float largest[kSize];  // by group: the longest diagonal below it, or more
  std::uint32_t first;   // member, if it is of members
  std::uint32_t is_of_members;
  std::uint32_t child[kSize];  // else its groups

  void set(std::uint32_t lane, const Box& box);
  Box box(std::uint32_t lane) const;
};

/// The convex hull of two boxes, against eight at a time.
class GroupShaft {
 public:
  GroupShaft(const Box& from, const Box& to);

  /// The lanes of a group that it may meet.
  unsigned may_meet(const BoxGroup& group) const {
    FloatBits meets = {-1, -1, -1, -1, -1, -1, -1, -1};
    for (std::size_t k = 0; k < 3; ++k) {
      meets &= (row(group.ends[k]) <= high_[k]) & (row(group.ends[BoxGroup::kHigh + k]) >= low_[k]);
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const Tangent& own = tangents_[i];
      meets &= own.u * row(group.ends[own.u_end]) + own.v * row(group.ends[own.v_end]) <= own.d;
    }
    return lanes_of(meets);
  }

 private:
  /// In the plane of an axis and the next one, the hull is where u x + v y <= d. The corner of a
  /// box that is deepest inside is at those of its ends.
  struct Tangent {
    float u, v, d;
    std::uint32_t u_end, v_end;
  };
  void add_tangents(std::size_t axis, const Box& from, const Box& to);

  float low_[3], high_[3];
  std::array<Tangent, 12> tangents_;
  std::size_t count_ = 0;
};

class BoxGroups {
 public:
  BoxGroups() = default;
  /// Of the members of a tree, which have its order. `largest`: of each node the longest diagonal
  /// below it.
  BoxGroups(const BoxTree& tree, std::span<const double> largest);

  /// Calls visit(member) for those that may meet the shaft, in order, below groups that
  /// enters(group, lane) accepts, until it says so.
  template <class Enters, class Visit>
  bool find(const GroupShaft& shaft, const Enters& enters, const Visit& visit) const {
    if (groups_.empty()) return false;
    // Three levels of the tree are one here, and it has at most 32.
    std::array<std::uint32_t, 11 * BoxGroup::kSize> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const BoxGroup& group = groups_[stack[--depth]];
      unsigned lanes = shaft.may_meet(group);
      if (group.is_of_members != 0) {
        for (; lanes != 0; lanes &= lanes - 1) {
          if (visit(group.first + static_cast<std::uint32_t>(std::countr_zero(lanes)))) return true;
        }
        continue;
      }
      while (lanes != 0) {  // the last first, so that the first is taken first
        const auto lane = static_cast<std::uint32_t>(std::bit_width(lanes)) - 1;
        lanes ^= 1U << lane;
        if (enters(group, lane)) stack[depth++] = group.child[lane];
      }
    }
    return false;
  }

 private:
  std::vector<BoxGroup> groups_;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_BOX_GROUPS_H
