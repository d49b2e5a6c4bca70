// SPDX-License-Identifier: LGPL-3.0-or-later
// The integers of the exact stage, from narrow to unbounded, and the two determinants that decide.
//
// The same source is compiled for each; the precision plan (precision_plan.h) says which is wide
// enough for a scene and a predicate. Exactness: exact as long as no intermediate exceeds the type,
// which the plan's bounds guarantee (docs/exactness.md; tests drive each width to its last bit).
#ifndef GNOMON_KERNEL_EXACT_INTEGER_H
#define GNOMON_KERNEL_EXACT_INTEGER_H

#include <gmpxx.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "gnomon/kernel/sign.h"

namespace gnomon {

__extension__ typedef __int128 Int128;
namespace mp = boost::multiprecision;
using Int512 = mp::number<mp::cpp_int_backend<512, 512, mp::signed_magnitude, mp::unchecked, void>,
                          mp::et_off>;

template <class Int>
using Vector3 = std::array<Int, 3>;

template <class Int>
Int integer_from(std::int64_t value) {
  return Int(static_cast<long>(value));
}
/// Requires: `value` fits into 64 bits unless Int is mpz_class.
template <class Int>
Int integer_from(const mpz_class& value) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return value;
  } else {
    return Int(value.get_si());
  }
}

template <class Int>
Vector3<Int> cross(const Vector3<Int>& a, const Vector3<Int>& b) {
  return {Int(a[1] * b[2] - a[2] * b[1]), Int(a[2] * b[0] - a[0] * b[2]),
          Int(a[0] * b[1] - a[1] * b[0])};
}
template <class Int>
Int dot(const Vector3<Int>& a, const Vector3<Int>& b) {
  return Int(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
template <class Int>
Vector3<Int> difference(const Vector3<Int>& a, const Vector3<Int>& b) {
  return {Int(a[0] - b[0]), Int(a[1] - b[1]), Int(a[2] - b[2])};
}
/// Sign of a . (b x c).
template <class Int>
Sign sign_of_determinant(const Vector3<Int>& a, const Vector3<Int>& b, const Vector3<Int>& c) {
  return sign_of(dot(a, cross(b, c)));
}
template <>
inline constexpr Sign sign_of(const Int128& value) {
  return value > 0 ? Sign::kPositive : value < 0 ? Sign::kNegative : Sign::kZero;
}
template <>
inline Sign sign_of(const mpz_class& value) {
  return static_cast<Sign>(sgn(value));
}

/// The double nearest to value * 2^-shift, up to one unit in the last place (GMP truncates):
/// relative error at most 2u, where nothing underflows.
inline double to_double_scaled(const mpz_class& value, long shift) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
  const long power = exponent - shift;
  if (power < -1100) return 0.0;
  return std::ldexp(mantissa, static_cast<int>(power));
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_EXACT_INTEGER_H
