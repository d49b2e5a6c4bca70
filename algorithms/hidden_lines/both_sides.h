// SPDX-License-Identifier: LGPL-3.0-or-later
// A count for the points of an edge moved a little to the left, and one for those moved to the
// right, as the viewer sees the edge run from its first to its second vertex. The two differ only
// where something else lies in the plane of edge and viewer.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_BOTH_SIDES_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_BOTH_SIDES_H

#include <algorithm>
#include <cstdint>

namespace gnomon {

struct BothSides {
  std::int64_t left = 0, right = 0;

  BothSides& operator+=(const BothSides& other) {
    left += other.left;
    right += other.right;
    return *this;
  }
  friend BothSides operator+(BothSides a, const BothSides& b) { return a += b; }
  friend BothSides operator-(const BothSides& a) { return {-a.left, -a.right}; }
  friend BothSides operator-(const BothSides& a, const BothSides& b) { return a + -b; }
  friend bool operator==(const BothSides&, const BothSides&) = default;

  std::uint32_t larger() const { return static_cast<std::uint32_t>(std::max(left, right)); }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_BOTH_SIDES_H
