// SPDX-License-Identifier: GPL-3.0-or-later
// A double with a bound of how far it is off: for signs that are certain without rational numbers.
//
// Exactness: none; a sign that is told is certain. Each sum and product adds half a unit in the
// last place of its value to the bounds that its operands bring along; kSlack covers the rounding
// of the bound's own five operations, kTiny what underflows. What overflows has no certain sign.
#ifndef GNOMON_ORACLE_GEOMETRY_BOUNDED_H
#define GNOMON_ORACLE_GEOMETRY_BOUNDED_H

#include <gmpxx.h>

#include <array>
#include <cmath>

#include "gnomon/kernel/sign.h"

namespace gnomon::oracle {

struct Bounded {
  double value = 0, error = 0;

  /// The sign, or kZero where it is not certain.
  Sign certain_sign() const { return std::fabs(value) > error ? sign_of(value) : Sign::kZero; }
};

namespace bounded_detail {

inline constexpr double kHalfUnit = 0x1p-53;
inline constexpr double kSlack = 1 + 0x1p-49;
inline constexpr double kTiny = 0x1p-1000;

}  // namespace bounded_detail

inline Bounded operator+(Bounded a, Bounded b) {
  using namespace bounded_detail;
  const double sum = a.value + b.value;
  return {sum, (a.error + b.error + std::fabs(sum) * kHalfUnit) * kSlack};
}
inline Bounded operator-(Bounded a, Bounded b) { return a + Bounded{-b.value, b.error}; }
inline Bounded operator*(Bounded a, Bounded b) {
  using namespace bounded_detail;
  const double product = a.value * b.value;
  const double error = std::fabs(a.value) * b.error + a.error * (std::fabs(b.value) + b.error) +
                       std::fabs(product) * kHalfUnit + kTiny;
  return {product, error * kSlack};
}

/// GMP cuts digits off, so that a unit in the last place may be missing.
template <class Number>
Bounded bounded(const Number& value) {
  using namespace bounded_detail;
  const double near = value.get_d();
  return {near, std::fabs(near) * 4 * kHalfUnit + kTiny};
}

using BoundedVector = std::array<Bounded, 3>;

template <class Number>
BoundedVector bounded(const std::array<Number, 3>& vector) {
  return {bounded(vector[0]), bounded(vector[1]), bounded(vector[2])};
}
inline BoundedVector minus(const BoundedVector& a, const BoundedVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Bounded dot(const BoundedVector& a, const BoundedVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline BoundedVector cross(const BoundedVector& a, const BoundedVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_BOUNDED_H
