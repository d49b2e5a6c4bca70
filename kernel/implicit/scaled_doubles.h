// SPDX-License-Identifier: LGPL-3.0-or-later
// Integer vectors as doubles of size 1, and how many bits integers have: what the planes of all
// spaces of kernel `plane` need when their filter is made ready.
//
// Exactness: a conversion is off by at most u of the integer up to 128 bits, and by 2u beyond (GMP
// and WideInteger truncate); scaling by a power of two is exact where nothing becomes subnormal.
#ifndef GNOMON_KERNEL_IMPLICIT_SCALED_DOUBLES_H
#define GNOMON_KERNEL_IMPLICIT_SCALED_DOUBLES_H

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kernel/numbers/exact_integer.h"

namespace gnomon {

using Double3 = std::array<double, 3>;

inline double dot(const Double3& a, const Double3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// The largest magnitude of a component.
inline double largest(const Double3& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}
/// 2^-k with magnitude * 2^-k in [1/2, 1). Requires: magnitude is in [2^-1022, 2^1022).
inline double normalizer(double magnitude) {
  // The exponent of the result, from the two biased ones: (1022 - (biased - 1023)) is 2045 -
  // biased.
  const std::uint64_t biased = std::bit_cast<std::uint64_t>(magnitude) >> 52;
  return std::bit_cast<double>((std::uint64_t{2045} - biased) << 52);
}

/// Requires: at most 1000 bits.
inline double to_double(std::int64_t value) { return static_cast<double>(value); }
inline double to_double(Int128 value) { return static_cast<double>(value); }
template <std::size_t Limbs>
double to_double(const WideInteger<Limbs>& value) {
  return to_double_scaled(value, 0);
}
template <class Int>
Double3 to_doubles(const Vector3<Int>& v) {
  return {to_double(v[0]), to_double(v[1]), to_double(v[2])};
}

/// Bits of the magnitude; 0 has none.
inline unsigned bits_of(const mpz_class& value) {
  return sgn(value) == 0 ? 0 : static_cast<unsigned>(mpz_sizeinbase(value.get_mpz_t(), 2));
}
inline unsigned bits_of(Int128 value) {
  const UInt128 magnitude = static_cast<UInt128>(value < 0 ? -value : value);
  const auto high = static_cast<std::uint64_t>(magnitude >> 64);
  return static_cast<unsigned>(high != 0 ? 64 + std::bit_width(high)
                                         : std::bit_width(static_cast<std::uint64_t>(magnitude)));
}
/// Of the largest component.
template <class Int>
unsigned bits_of(const Vector3<Int>& v) {
  return std::max({bits_of(v[0]), bits_of(v[1]), bits_of(v[2])});
}
/// For integers that may be beyond doubles, the bits of the magnitude; 0 for all others.
template <class Int>
long excess_bits(const Int& value) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return long{bits_of(value)};
  } else {
    return 0;
  }
}
template <class Int>
bool is_zero(const Vector3<Int>& v) {
  return sign_of(v[0]) == Sign::kZero && sign_of(v[1]) == Sign::kZero &&
         sign_of(v[2]) == Sign::kZero;
}

/// The vector as doubles, scaled by a power of two so that the largest component is in [1/2, 1),
/// after component k was multiplied by 2^stretch[k]. Each is off by at most 2u of itself, or by
/// 2^-1074 where it underflows. False: the vector is zero.
template <class Int>
bool to_normalized(const Vector3<Int>& v, const std::array<int, 3>& stretch, Double3& result) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    long most = std::numeric_limits<long>::min();
    for (int k = 0; k < 3; ++k) {
      if (sgn(v[k]) != 0) most = std::max(most, long{bits_of(v[k])} + stretch[k]);
    }
    if (most == std::numeric_limits<long>::min()) return false;
    for (int k = 0; k < 3; ++k) result[k] = to_double_scaled(v[k], most - stretch[k]);
  } else {
    for (int k = 0; k < 3; ++k) {
      result[k] = to_double(v[k]);
      if (stretch[k] != 0) result[k] = std::ldexp(result[k], stretch[k]);
    }
    const double magnitude = largest(result);
    if (magnitude == 0) return false;
    const double scale = normalizer(magnitude);
    for (double& x : result) x *= scale;
  }
  return true;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_SCALED_DOUBLES_H
