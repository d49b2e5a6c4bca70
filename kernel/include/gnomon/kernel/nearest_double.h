// SPDX-License-Identifier: LGPL-3.0-or-later
// From rationals to doubles: the nearest one, and a proven enclosure.
#ifndef GNOMON_KERNEL_NEAREST_DOUBLE_H
#define GNOMON_KERNEL_NEAREST_DOUBLE_H

#include <gmpxx.h>

#include <cmath>

#include "gnomon/kernel/ball.h"

namespace gnomon {

/// The double nearest to a rational, ties to even. Where the nearest would be beyond the largest
/// finite double, what GMP truncates to.
inline double nearest_double(const mpq_class& value) {
  // GMP truncates towards zero: the answer is that or the next double away from zero.
  const double low = value.get_d();
  const double high = std::nextafter(low, sgn(value) > 0 ? INFINITY : -INFINITY);
  if (!std::isfinite(low) || !std::isfinite(high)) return low;
  const mpq_class to_low = abs(value - mpq_class(low)), to_high = abs(mpq_class(high) - value);
  if (to_low != to_high) return to_low < to_high ? low : high;
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(low, &exponent), 53);
  return std::fmod(mantissa, 2) == 0 ? low : high;
}

/// Truncation errs by less than one unit in the last place, 2u |value|, or by 2^-1074 among the
/// subnormal numbers, which kTiny covers.
inline Ball enclose(const mpq_class& value) {
  const double truncated = value.get_d();
  return {truncated, 2 * Ball::kUnit * std::fabs(truncated) * Ball::kInflate + Ball::kTiny};
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_NEAREST_DOUBLE_H
