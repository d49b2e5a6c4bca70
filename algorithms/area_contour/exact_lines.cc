// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/exact_lines.h"

#include <algorithm>
#include <limits>

namespace gnomon::area_contour {

/// The ends of a line in the receiver, told from the sides of the corners. It has its outline on
/// the left, and enters, end 0, where corners go over to its other side.
template <class AtCorner, class AtEdge>
void ExactLines::for_ends(const OutlineLine& line, const AtCorner& at_corner,
                          const AtEdge& at_edge) const {
  const std::uint32_t n = chart_.size();
  for (std::uint32_t k = 0; k < n; ++k) {
    if (!has(line.before | line.behind, k)) {
      at_corner(has(line.before, k == 0 ? n - 1 : k - 1) ? 0u : 1u, k);
    } else if (has(line.before, k) && has(line.behind, chart_.next(k))) {
      at_edge(0u, k);
    } else if (has(line.behind, k) && has(line.before, chart_.next(k))) {
      at_edge(1u, k);
    }
  }
}

/// With values a and a' of the line `a` at the ends of the edge, and l and l' of `line`, the point
/// is a share a / (a - a') along the edge, and the value there (a l' - a' l) / (a - a'). Products
/// are off by 2^-104 of each factor and 2^-102 of themselves, and their difference by 2^-103 of the
/// sum of both: 2^-100 of that sum, and u for the pair's lower part, which is left off. Integers
/// below 2^53 are doubles, and nothing is off: so lines of coarse grids that are one are known.
ExactLines::BorderValue ExactLines::value_at_border(const OutlineLine& line, const OutlineLine& a,
                                                    std::uint32_t corner) {
  const std::uint32_t next = chart_.next(corner);
  const DoubleDouble here = value_at(a, corner), there = value_at(a, next);
  const DoubleDouble value = value_at(line, corner), value_there = value_at(line, next);
  const DoubleDouble p = here * value_there, q = there * value;
  const DoubleDouble difference = p - q;
  BorderValue result;
  result.value = here.high > 0 ? difference.high : -difference.high;
  result.error =
      0x1p-100 * (std::fabs(p.high) + std::fabs(q.high)) + Ball::kUnit * std::fabs(difference.high);
  result.factor = std::fabs(here.high) + std::fabs(there.high);
  const double largest =
      std::max({result.factor, std::fabs(value.high), std::fabs(value_there.high)});
  if (largest < 0x1p53 && difference.high == 0) result.error = 0;
  return result;
}

Side ExactLines::side_at_border(const OutlineLine& line, const OutlineLine& a,
                                std::uint32_t corner) {
  const BorderValue value = value_at_border(line, a, corner);
  return value.has_sign() ? side_of(value.value) : exact_side_at_border(line, a, corner);
}

std::array<Side, 2> ExactLines::sides_at_ends(const OutlineLine& line, const OutlineLine& along) {
  std::array<Side, 2> sides = {Side::kOn, Side::kOn};
  for_ends(
      along, [&](std::uint32_t end, std::uint32_t k) { sides[end] = side_of_corner(line, k); },
      [&](std::uint32_t end, std::uint32_t k) { sides[end] = side_at_border(line, along, k); });
  return sides;
}

// From the ends P and P' of the line in the receiver and the values v and v' of the other one
// there, which have different signs: P + t (P' - P) with t = |v| / (|v| + |v'|).
//
// A corner's place is off by (|a| + |b|) `error` <= 1.42 `error` and rounds by 3u `reach`. One on
// an edge is off as its corners are, by 6u of the edge's length for the share, and rounds by 5u
// `reach`: 1.42 `error` + 20u `reach` in all. So is what lies between two of them, but for t and
// for roundings of 5u `reach`. Values that are off by e and e' move t by (e |v'| + e' |v|) / (|v| +
// |v'|)^2, and it rounds by 2u.
Ball ExactLines::place_on(const OutlineLine& line, const OutlineLine& by) {
  constexpr double kMostError = 0x1p-20;  // a choice, of values against their sum
  struct {
    double place = 0, value = 0, error = 0;
  } ends[2];
  const auto place_of = [&](std::uint32_t corner) {
    const auto& [x, y] = chart_.corners[corner];
    return line.b * x - line.a * y;
  };
  for_ends(
      line,
      [&](std::uint32_t end, std::uint32_t k) {
        const double value = value_at(by, k).high;
        ends[end] = {place_of(k), value, Ball::kUnit * std::fabs(value)};
      },
      [&](std::uint32_t end, std::uint32_t k) {
        const double from = place_of(k), to = place_of(chart_.next(k));
        const BorderValue value = value_at_border(by, line, k);
        const double share = std::fabs(value_at(line, k).high) / value.factor;
        const double at = value.value / value.factor;
        ends[end] = {from + share * (to - from), at,
                     value.error / value.factor + 4 * Ball::kUnit * std::fabs(at)};
      });
  const double first = std::fabs(ends[0].value), last = std::fabs(ends[1].value);
  const double first_error = ends[0].error, last_error = ends[1].error, both = first + last;
  const bool cross =
      (ends[0].value < 0) != (ends[1].value < 0) && first > first_error && last > last_error;
  if (!cross || !(first_error + last_error < kMostError * both) ||
      !(both < std::numeric_limits<double>::infinity())) {
    return exact_place_on(line, by);
  }
  const double t = first / both, step = ends[1].place - ends[0].place;
  const double t_error = 1.01 * (first_error * (last / both) + last_error * t) / both;
  return {ends[0].place + t * step, 1.5 * chart_.error + 28 * Ball::kUnit * chart_.reach +
                                        std::fabs(step) * (t_error + 4 * Ball::kUnit)};
}

}  // namespace gnomon::area_contour
