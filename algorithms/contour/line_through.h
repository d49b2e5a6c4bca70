// SPDX-License-Identifier: LGPL-3.0-or-later
// Where a line goes through a convex polygon, by the sides of the line on which its corners are,
// and which part of an edge is inside.
#ifndef GNOMON_ALGORITHMS_CONTOUR_LINE_THROUGH_H
#define GNOMON_ALGORITHMS_CONTOUR_LINE_THROUGH_H

#include <array>
#include <cstdint>

namespace gnomon {

/// Which sides of a line a polygon covers along it.
enum class LineCover : std::uint8_t { kNone, kBoth, kInner, kOuter };

/// Where the line of an edge goes through a polygon: it enters through edge `in` and leaves through
/// edge `out`, or through a corner of these that is on the line.
struct LineThrough {
  static constexpr std::uint32_t kNoCorner = 0xffffffffu;
  LineCover cover = LineCover::kNone;
  std::uint32_t in = 0, out = 0;
  std::uint32_t in_corner = kNoCorner, out_corner = kNoCorner;
};

/// Corners of a polygon on the left and on the right of a line, as bits; the others are on it.
struct CornerSet {
  static constexpr std::uint32_t kMost = 64;
  std::uint64_t left = 0, right = 0;
};

/// Whether a part of a line from one point to another is inside of a convex polygon, and whether
/// it begins and ends with these.
struct IntervalEnds {
  bool meets = false, starts_inside = false, ends_inside = false;
};

/// By sign(leaves, at_to): of the line through which the line enters, or leaves, at the first point
/// or at the last one, positive inside; only what is needed is asked for.
///
/// A first point that is on the line of entry is inside if the last one is. For polygons in all
/// directions around a lamp: an edge and the part of its line in the polygon are arcs of one great
/// circle, each shorter than half of it, so that an edge that starts on the inner side of both
/// lines meets the polygon at once or not at all.
template <class SignOf>
IntervalEnds ends_of_interval(const SignOf& sign) {
  IntervalEnds ends;
  const int enters_from = sign(false, false);
  ends.starts_inside = enters_from > 0;
  if (!ends.starts_inside) {
    if (sign(false, true) <= 0) return ends;
    ends.starts_inside = enters_from == 0;
  }
  const int leaves_to = sign(true, true);
  ends.ends_inside = leaves_to >= 0;
  ends.meets = (!ends.starts_inside && ends.ends_inside) || sign(true, false) > 0;
  return ends;
}

/// The same where no sign is zero, from those that are positive.
constexpr IntervalEnds ends_of_known_interval(bool enters_from, bool enters_to, bool leaves_from,
                                              bool leaves_to) {
  const bool meets = (enters_from | enters_to) & ((!enters_from & leaves_to) | leaves_from);
  return {meets, enters_from, leaves_to};
}

/// A sign that bounds may leave open.
struct MaybeSign {
  int sign = 0;
  bool known = true;
};

/// Where a line goes through a polygon of three or four corners, by the set of those on its left:
/// it enters through an edge from the left to the right, and leaves through one back.
struct BlockEnds {
  std::uint8_t in = 0, out = 0;
};
constexpr BlockEnds ends_of_block(unsigned n, unsigned left) {
  BlockEnds ends;
  for (unsigned k = n; k-- > 0;) {
    const bool here = left >> k & 1, then = left >> (k + 1) % n & 1;
    if (here && !then) ends.in = static_cast<std::uint8_t>(k);
    if (!here && then) ends.out = static_cast<std::uint8_t>(k);
  }
  return ends;
}
inline constexpr auto kBlockEnds = [] {
  std::array<std::array<BlockEnds, 16>, 2> table{};
  for (unsigned n = 3; n <= 4; ++n) {
    for (unsigned left = 0; left < 1u << n; ++left) table[n - 3][left] = ends_of_block(n, left);
  }
  return table;
}();
/// The bits of BlockSigns that are of lines and corners that there are, and the lowest bit of each
/// of its lines for which any corner is in a set.
inline constexpr auto kValidSigns = [] {
  std::array<std::array<std::uint16_t, 5>, 5> table{};
  for (unsigned lines = 1; lines <= 4; ++lines) {
    for (unsigned corners = 1; corners <= 4; ++corners) {
      table[lines][corners] =
          static_cast<std::uint16_t>((0x1111u >> 4 * (4 - lines)) * ((1u << corners) - 1));
    }
  }
  return table;
}();
constexpr unsigned valid_signs(std::uint32_t lines, std::uint32_t corners) {
  return kValidSigns[lines][corners];
}
constexpr unsigned lines_with_any(unsigned set) {
  return (set | set >> 1 | set >> 2 | set >> 3) & 0x1111u;
}
/// The same of lines for which two corners are.
constexpr unsigned lines_with_two(unsigned set) {
  if (set == 0) return 0;
  const unsigned sum =
      (set & 0x1111u) + (set >> 1 & 0x1111u) + (set >> 2 & 0x1111u) + (set >> 3 & 0x1111u);
  return (sum >> 1 | sum >> 2) & 0x1111u;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_LINE_THROUGH_H
