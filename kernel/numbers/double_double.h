// SPDX-License-Identifier: LGPL-3.0-or-later
// Unevaluated sums of two doubles, for some 104 bits of precision where an answer has to be the
// nearest double: computed once more, with a bound, and rounded if the bound allows.
//
// Exactness: the sum and the product of two doubles are exact (two_sum, two_product); operations on
// pairs have the relative errors stated with them, as long as nothing over- or underflows (results
// within 2^-900 and 2^900: whoever asks for a nearest double checks that). Reference: T. J. Dekker,
// A floating-point technique for extending the available precision, Numer. Math. 18 (1971); M.
// Joldes, J.-M. Muller, V. Popescu, Tight and rigorous error bounds for basic building blocks of
// double-word arithmetic, ACM TOMS 44 (2017).
//
// Tests: tests/kernel/double_double_test.cc holds every error bound against rationals.
#ifndef GNOMON_KERNEL_NUMBERS_DOUBLE_DOUBLE_H
#define GNOMON_KERNEL_NUMBERS_DOUBLE_DOUBLE_H

#include <gmpxx.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "kernel/numbers/exact_integer.h"

namespace gnomon {

struct DoubleDouble {
  double high = 0, low = 0;  // |low| <= half a unit in the last place of high
};

/// a + b exactly. Requires: |a| >= |b|, or a is 0.
inline DoubleDouble quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}
/// a + b exactly (Knuth).
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}
/// a b exactly; std::fma is correctly rounded whether the machine has it or not.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
/// Error at most 2^-103 (|a| + |b|).
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = two_sum(a.high, b.high);
  return quick_two_sum(s.high, s.low + (a.low + b.low));
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
/// Relative error at most 2^-102.
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = two_product(a.high, b.high);
  return quick_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
/// Relative error at most 2^-101.
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble product = two_product(first, b.high);
  const double rest = ((a.high - product.high) - product.low + a.low - first * b.low) / b.high;
  return quick_two_sum(first, rest);
}
/// Requires: a > 0. Relative error at most 2^-102: with h = sqrt(a.high) off by u, the root is
/// h + (a - h^2) / 2h within 9u^2 / 8 of h, and that quotient, at most 3u / 2 of h, is off by three
/// roundings.
inline DoubleDouble square_root(const DoubleDouble& a) {
  const double root = std::sqrt(a.high);
  const DoubleDouble square = two_product(root, root);
  const double rest = ((a.high - square.high) - square.low + a.low) / (2 * root);
  return quick_two_sum(root, rest);
}

/// The integer as a pair: relative error at most 2^-104.
inline DoubleDouble double_double(std::int64_t value) {
  const auto high = static_cast<double>(value);
  // The conversion of 2^63 - 1 is 2^63, which only 128 bits hold.
  return {high, static_cast<double>(Int128{value} - static_cast<Int128>(high))};
}
inline DoubleDouble double_double(Int128 value) {
  // Of 117 bits in three parts that are doubles, faster than conversions of 128 bits.
  const auto top = static_cast<std::int64_t>(value >> 64);
  constexpr std::int64_t kTop = std::int64_t{1} << 53;
  if (-kTop < top && top < kTop) {
    const auto rest = static_cast<std::uint64_t>(value);
    const DoubleDouble upper =
        two_sum(static_cast<double>(top) * 0x1p64, static_cast<double>(rest >> 32) * 0x1p32);
    return two_sum(upper.high, upper.low + static_cast<double>(rest & 0xffffffffu));
  }
  const auto high = static_cast<double>(value);
  if (!(std::fabs(high) < 0x1p126)) {
    return {std::copysign(std::numeric_limits<double>::infinity(), high), 0};
  }
  return {high, static_cast<double>(value - static_cast<Int128>(high))};
}
/// Infinite beyond 2^1000.
inline DoubleDouble double_double(const mpz_class& value) {
  if (mpz_sizeinbase(value.get_mpz_t(), 2) > 1000) {
    return {std::copysign(std::numeric_limits<double>::infinity(), sgn(value)), 0};
  }
  const double high = value.get_d();  // truncated
  const mpz_class rest = value - mpz_class(high);
  return quick_two_sum(high, rest.get_d());
}
/// Times 2^-scale_down, the leading 125 bits: relative error at most 2^-104. Infinite beyond 2^900.
template <std::size_t Limbs>
DoubleDouble double_double(const WideInteger<Limbs>& value, int scale_down = 0) {
  const WideInteger<Limbs> magnitude = value.is_negative() ? -value : value;
  std::size_t top = Limbs - 1;
  while (top > 0 && magnitude.limb(top) == 0) --top;
  if (top == 0 && magnitude.limb(0) == 0) return {};
  const int shift = std::countl_zero(magnitude.limb(top));
  const auto leading = [&](std::size_t below) {  // 64 bits from limb top - below on, shifted up
    if (below > top) return std::uint64_t{0};
    const std::uint64_t next = below < top ? magnitude.limb(top - below - 1) : 0;
    const std::uint64_t here = magnitude.limb(top - below) << shift;
    return shift == 0 ? here : here | next >> (64 - shift);
  };
  const UInt128 bits = UInt128{leading(0)} << 64 | leading(1);
  const int exponent = 64 * (static_cast<int>(top) - 1) - shift + 3 - scale_down;
  if (exponent > 770) {
    return {std::copysign(std::numeric_limits<double>::infinity(), value.is_negative() ? -1 : 1),
            0};
  }
  DoubleDouble result = double_double(static_cast<Int128>(bits >> 3));
  if (value.is_negative()) result = {-result.high, -result.low};
  return {std::ldexp(result.high, exponent), std::ldexp(result.low, exponent)};
}
/// A rational: relative error at most 2^-100.
inline DoubleDouble double_double(const mpq_class& value) {
  return double_double(value.get_num()) / double_double(value.get_den());
}

/// The double nearest to any real number within `error` of `value`; nothing if it is not the same
/// for all of them, or where the bounds of this header do not hold.
inline std::optional<double> nearest_double(const DoubleDouble& value, double error) {
  const double magnitude = std::fabs(value.high);
  if (value.high == 0 && value.low == 0 && error == 0) return 0.0;
  if (!(magnitude > 0x1p-800) || !(magnitude < 0x1p800) || !(error < magnitude))
    return std::nullopt;
  // Adding to `high` rounds to nearest; a slightly larger error covers the rounding of low +-
  // error.
  const double wide = error * (1 + 0x1p-40) + std::fabs(value.low) * 0x1p-52;
  const double below = value.high + (value.low - wide), above = value.high + (value.low + wide);
  if (below != above) return std::nullopt;
  return below;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_NUMBERS_DOUBLE_DOUBLE_H
