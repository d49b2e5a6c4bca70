// SPDX-License-Identifier: LGPL-3.0-or-later
// The integers that preparation decides with: 64, 128 and 256 bits where the scene's grid lets
// every determinant fit, GMP integers where it does not.
#ifndef GNOMON_SCENE_BASE_EXACT_INT_H
#define GNOMON_SCENE_BASE_EXACT_INT_H

#include <gmpxx.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>

#include "gnomon/kernel/geometry.h"

namespace gnomon::scene_detail {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;
using Int256 = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    256, 256, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;

/// Bits, sign included, of the largest quantity on b-bit coordinates: n . (p - q), with n the area
/// vector of a polygon of `corners` vertices. n is a sum of at most corners - 2 cross products of
/// differences, each component of which is below 2^(2b+1); a difference is below 2^b; the dot
/// product has three terms: together below 3 (corners - 2) 2^(3b+1).
///
/// What else there is stays below that. Sides of doubled coordinates (midpoints) are degree 2 and
/// below 2^(2b+3). The area of a ring that was refined where others touch it has at most corners *
/// 2^b terms below 2^(2b+1), for an edge has at most 2^b points of the grid inside. A plane's key
/// is n . p with one or with n as above.
/// Requires: corners >= 3, those of holes and two more a hole, for its bridge, included.
constexpr unsigned bits_needed(unsigned b, std::size_t corners) {
  return 3 * b + 2 + static_cast<unsigned>(std::bit_width(3 * (corners - 2)));
}

inline std::uint64_t magnitude(std::int64_t value) {
  return value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
}
inline UInt128 magnitude(Int128 value) {
  return value < 0 ? -static_cast<UInt128>(value) : static_cast<UInt128>(value);
}

inline int trailing_zeros(UInt128 value) {
  const auto low = static_cast<std::uint64_t>(value);
  return low != 0 ? std::countr_zero(low)
                  : 64 + std::countr_zero(static_cast<std::uint64_t>(value >> 64));
}

/// Greatest common divisor, by halving. std::gcd does not take 128 bits, and Boost's gcd takes 1.5
/// times as long. gcd(0, a) = a.
inline UInt128 gcd_of(UInt128 a, UInt128 b) {
  if (a == 0) return b;
  if (b == 0) return a;
  const int shift = trailing_zeros(a | b);
  a >>= trailing_zeros(a);
  while (b != 0) {
    b >>= trailing_zeros(b);
    if ((a >> 64) == 0 && (b >> 64) == 0) {
      return static_cast<UInt128>(
                 std::gcd(static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b)))
             << shift;
    }
    if (a > b) std::swap(a, b);
    b -= a;
  }
  return a << shift;
}

inline std::int64_t gcd_of(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(std::gcd(magnitude(a), magnitude(b)));
}
inline Int128 gcd_of(Int128 a, Int128 b) {
  return static_cast<Int128>(gcd_of(magnitude(a), magnitude(b)));
}
inline Int256 gcd_of(const Int256& a, const Int256& b) {
  static const Int256 kLimit = Int256(1) << 127;
  const Int256 x = abs(a);
  const Int256 y = abs(b);
  if (x < kLimit && y < kLimit) {
    const UInt128 g = gcd_of(static_cast<UInt128>(x), static_cast<UInt128>(y));
    return Int256(static_cast<std::uint64_t>(g)) |
           (Int256(static_cast<std::uint64_t>(g >> 64)) << 64);
  }
  return boost::multiprecision::gcd(x, y);
}
inline mpz_class gcd_of(const mpz_class& a, const mpz_class& b) { return gcd(a, b); }

inline mpz_class to_mpz(std::int64_t value) { return static_cast<long>(value); }
inline mpz_class to_mpz(UInt128 value) {
  mpz_class result = static_cast<unsigned long>(value >> 64);
  result <<= 64;
  return result + static_cast<unsigned long>(value);
}
inline mpz_class to_mpz(Int128 value) {
  const mpz_class result = to_mpz(magnitude(value));
  return value < 0 ? mpz_class(-result) : result;
}
inline mpz_class to_mpz(const Int256& value) {
  mpz_class result = 0;
  const auto& backend = value.backend();
  for (unsigned i = backend.size(); i-- > 0;) {
    result <<= 64;
    result += static_cast<unsigned long>(backend.limbs()[i]);
  }
  return backend.sign() ? mpz_class(-result) : result;
}
inline const mpz_class& to_mpz(const mpz_class& value) { return value; }

/// For hashing only.
inline std::uint64_t mix(std::uint64_t h, std::uint64_t word) {
  h ^= word;
  h *= 0x9e3779b97f4a7c15u;
  return h ^ (h >> 29);
}
inline std::uint64_t hash_into(std::uint64_t h, std::int64_t value) {
  return mix(h, static_cast<std::uint64_t>(value));
}
inline std::uint64_t hash_into(std::uint64_t h, Int128 value) {
  return mix(mix(h, static_cast<std::uint64_t>(value)),
             static_cast<std::uint64_t>(static_cast<UInt128>(value) >> 64));
}
inline std::uint64_t hash_into(std::uint64_t h, const Int256& value) {
  const auto& backend = value.backend();
  h = mix(h, backend.sign() ? 1 : 0);
  for (unsigned i = 0; i < backend.size(); ++i) h = mix(h, backend.limbs()[i]);
  return h;
}
inline std::uint64_t hash_into(std::uint64_t h, const mpz_class& value) {
  h = mix(h, static_cast<std::uint64_t>(sgn(value) + 2));
  const std::size_t size = mpz_size(value.get_mpz_t());
  for (std::size_t i = 0; i < size; ++i)
    h = mix(h, mpz_getlimbn(value.get_mpz_t(), static_cast<mp_size_t>(i)));
  return h;
}

/// A grid coordinate as Int. Requires: it fits (Int256: at most 128 bits).
template <class Int>
Int coordinate(const GridPositions& grid, VertexId vertex, int axis) {
  if (grid.is_narrow()) {
    if constexpr (std::is_same_v<Int, mpz_class>) {
      return mpz_class(static_cast<long>(grid.narrow(vertex, axis)));
    } else {
      return Int(grid.narrow(vertex, axis));
    }
  }
  const mpz_class& value = grid.wide(vertex, axis);
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return value;
  } else if constexpr (sizeof(Int) <= sizeof(std::int64_t)) {
    return static_cast<Int>(value.get_si());
  } else {
    const auto low = static_cast<std::uint64_t>(mpz_getlimbn(value.get_mpz_t(), 0));
    const auto high = static_cast<std::uint64_t>(mpz_getlimbn(value.get_mpz_t(), 1));
    return Int(low) | (Int(high) << 64);
  }
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_BASE_EXACT_INT_H
