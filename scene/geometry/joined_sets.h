// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers 0, 1, ... in disjoint sets that are joined two by two (union-find).
#ifndef GNOMON_SCENE_GEOMETRY_JOINED_SETS_H
#define GNOMON_SCENE_GEOMETRY_JOINED_SETS_H

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gnomon::scene_detail {

/// Every set is known by its smallest member.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  /// The smallest member of the set that `member` is in.
  std::uint32_t first(std::uint32_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = first(a);
    b = first(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GEOMETRY_JOINED_SETS_H
