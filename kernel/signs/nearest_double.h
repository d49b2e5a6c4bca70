// SPDX-License-Identifier: LGPL-3.0-or-later
// From rationals to doubles: the nearest one, and a proven enclosure.
#ifndef GNOMON_KERNEL_SIGNS_NEAREST_DOUBLE_H
#define GNOMON_KERNEL_SIGNS_NEAREST_DOUBLE_H

#include <gmpxx.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "kernel/signs/ball.h"

namespace gnomon {

/// The double nearest to a rational, ties to even, as IEEE 754 rounds: an infinity from halfway
/// between the largest finite double and 2^1024.
inline double nearest_double(const mpq_class& value) {
  // GMP truncates towards zero: the answer is that or the next double away from zero.
  const double low = value.get_d();
  if (std::isinf(low)) return low;
  const double high = std::nextafter(low, sgn(value) < 0 ? -INFINITY : INFINITY);
  const mpq_class magnitude = abs(value);
  const mpq_class beyond =
      std::isinf(high) ? mpq_class(mpz_class(1) << 1024) : mpq_class(std::fabs(high));
  const int order = cmp(magnitude - mpq_class(std::fabs(low)), beyond - magnitude);
  if (order != 0) return order < 0 ? low : high;
  return (std::bit_cast<std::uint64_t>(low) & 1) == 0 ? low : high;
}

/// Truncation errs by less than one unit in the last place, 2u |value|, or by 2^-1074 among the
/// subnormal numbers, which kTiny covers.
inline Ball enclose(const mpq_class& value) {
  const double truncated = value.get_d();
  return {truncated, 2 * Ball::kUnit * std::fabs(truncated) * Ball::kInflate + Ball::kTiny};
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_SIGNS_NEAREST_DOUBLE_H
