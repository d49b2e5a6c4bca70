// SPDX-License-Identifier: LGPL-3.0-or-later
// Areas of loops in pairs of doubles (kernel/numbers/double_double.h), for kernels that know the
// corners of a loop so well: a fraction of a part is then certain to some 2^-90 of the part, so
// that sums over thousands of pieces are certain beyond the last digit of a double.
//
// Exactness: certified enclosures. Bounds are those of piece_fractions.h with the roundings of
// pairs: 2^-102 of a product, 2^-103 of both terms of a sum.
#ifndef GNOMON_ALGORITHMS_PARTITION_PAIR_AREA_H
#define GNOMON_ALGORITHMS_PARTITION_PAIR_AREA_H

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kernel/numbers/double_double.h"
#include "kernel/signs/ball.h"

namespace gnomon {

/// A number within `radius` of `middle`.
struct PairBall {
  /// A fraction of a part that is less well known in pairs is found as a rational.
  static constexpr double kWidest = 0x1p-60;

  DoubleDouble middle;
  double radius = 0;

  PairBall() = default;
  PairBall(const DoubleDouble& value, double error) : middle(value), radius(error) {}
  explicit PairBall(const Ball& ball) : middle{ball.middle, 0}, radius(ball.radius) {}
  /// Of a rational between 0 and 1, whatever its integers. Both conversions truncate: the rest is
  /// below 2^-52 of the number, and off by as much of itself.
  static PairBall of(const mpq_class& value) {
    const double high = value.get_d();
    const mpq_class rest = value - mpq_class(high);
    return {quick_two_sum(high, rest.get_d()), 0x1.01p-104 * high + Ball::kTiny};
  }
};

/// Infinite radius if b may be zero.
inline PairBall operator/(const PairBall& a, const PairBall& b) {
  const double least = (std::fabs(b.middle.high) - b.radius) * (1 - 0x1p-50);
  if (!(least > 0)) return {{}, std::numeric_limits<double>::infinity()};
  const DoubleDouble middle = a.middle / b.middle;
  const double size = std::fabs(middle.high);
  return {middle, (a.radius + size * b.radius) / least * 1.001 + 0x1p-100 * size + Ball::kTiny};
}

/// Twice the signed area of a loop whose corners are at point_of(corner), a pair a coordinate with
/// one error for both. The radius is infinite or not a number where nothing is known.
template <class Loop, class PointOf>
PairBall twice_pair_area(const Loop& loop, const PointOf& point_of) {
  const auto origin = point_of(loop.corner(0));
  DoubleDouble x, y, sum;
  double spread = 0, most = 0, error = origin.error;
  double far = std::max(std::fabs(origin.x.high), std::fabs(origin.y.high));
  for (std::uint32_t i = 1; i < loop.size(); ++i) {
    const auto p = point_of(loop.corner(i));
    const DoubleDouble next_x = p.x - origin.x, next_y = p.y - origin.y;
    sum = sum + (x * next_y - y * next_x);
    const double size = std::fabs(next_x.high) + std::fabs(next_y.high);
    spread += size;
    most = std::max(most, size);
    far = std::max({far, std::fabs(p.x.high), std::fabs(p.y.high)});
    error = std::max(error, p.error);
    x = next_x;
    y = next_y;
  }
  const auto n = static_cast<double>(loop.size());
  const double d = 2 * error + 0x1p-101 * far;
  const double radius = 2 * d * (spread + n * d) + 2 * n * (n + 4) * 0x1p-101 * most * most;
  const double overflow = sum.high - sum.high;  // not a number if the sum is none; else 0
  return {sum, radius * 1.001 + overflow + 8 * n * Ball::kTiny};
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_PAIR_AREA_H
