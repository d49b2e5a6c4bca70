// SPDX-License-Identifier: LGPL-3.0-or-later
// Signed integers of a fixed number of 64-bit limbs: the exact stage beyond 128 bits.
//
// Two's complement, least significant limb first, trivially copyable, no allocation. The factors of
// a product may be narrower than it: a cross product of 128-bit planes then costs four limb
// products a term, where equal widths of 512 bits cost 36 (wide_product). This is why boost's
// cpp_int does not serve; measured in docs/exactness.md.
//
// Exactness: +, - and products are exact modulo 2^kBits. So a result is right if its own value lies
// in [-2^(kBits-1), 2^(kBits-1)), even where an intermediate left that range. That it does is what
// the precision plan proves (precision_plan.h); tests compare every operation with GMP at its
// limits.
#ifndef GNOMON_KERNEL_NUMBERS_WIDE_INTEGER_H
#define GNOMON_KERNEL_NUMBERS_WIDE_INTEGER_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "gnomon/kernel/sign.h"

namespace gnomon {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

static_assert(sizeof(mp_limb_t) == sizeof(std::uint64_t) && GMP_NAIL_BITS == 0,
              "GMP's limbs must be 64 bits");

/// Default: zero. Requires: Limbs >= 1.
template <std::size_t Limbs>
class WideInteger {
 public:
  static constexpr std::size_t kLimbs = Limbs;
  static constexpr std::size_t kBits = 64 * Limbs;

  constexpr WideInteger() = default;
  constexpr explicit WideInteger(std::int64_t value) {
    limbs_[0] = static_cast<std::uint64_t>(value);
    extend_sign(1);
  }
  constexpr explicit WideInteger(Int128 value) {
    limbs_[0] = static_cast<std::uint64_t>(value);
    if constexpr (Limbs > 1) {
      limbs_[1] = static_cast<std::uint64_t>(value >> 64);
      extend_sign(2);
    }
  }
  /// Modulo 2^kBits.
  template <std::size_t Others>
  constexpr explicit WideInteger(const WideInteger<Others>& other) {
    constexpr std::size_t kShared = std::min(Limbs, Others);
    for (std::size_t i = 0; i < kShared; ++i) limbs_[i] = other.limb(i);
    extend_sign(kShared);
  }
  /// Modulo 2^kBits.
  explicit WideInteger(const mpz_class& value) {
    const std::size_t size = std::min(Limbs, mpz_size(value.get_mpz_t()));
    const mp_limb_t* limbs = mpz_limbs_read(value.get_mpz_t());
    for (std::size_t i = 0; i < size; ++i) limbs_[i] = limbs[i];
    if (sgn(value) < 0) *this = -*this;
  }

  constexpr std::uint64_t limb(std::size_t i) const { return limbs_[i]; }
  constexpr bool is_negative() const { return (limbs_[Limbs - 1] >> 63) != 0; }

  constexpr WideInteger& operator+=(const WideInteger& other) {
    UInt128 carry = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      carry += limbs_[i];
      carry += other.limbs_[i];
      limbs_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return *this;
  }
  constexpr WideInteger& operator-=(const WideInteger& other) {
    subtract_shifted<0>(other, ~std::uint64_t{0});
    return *this;
  }
  friend constexpr WideInteger operator+(WideInteger a, const WideInteger& b) { return a += b; }
  friend constexpr WideInteger operator-(WideInteger a, const WideInteger& b) { return a -= b; }
  constexpr WideInteger operator-() const { return WideInteger() - *this; }
  friend constexpr WideInteger operator*(const WideInteger& a, const WideInteger& b) {
    return wide_product<Limbs>(a, b);
  }
  friend constexpr bool operator==(const WideInteger&, const WideInteger&) = default;

  /// a b modulo 2^(64 Result): exact if Result >= A + B.
  template <std::size_t Result, std::size_t A, std::size_t B>
  friend constexpr WideInteger<Result> wide_product(const WideInteger<A>& a,
                                                    const WideInteger<B>& b);

 private:
  template <std::size_t>
  friend class WideInteger;

  /// All ones if the highest bit is set, without a branch (signs are hard to predict).
  static constexpr std::uint64_t mask_of_sign(std::uint64_t limb) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(limb) >> 63);
  }
  constexpr std::uint64_t sign_mask() const { return mask_of_sign(limbs_[Limbs - 1]); }
  /// Fills the limbs from `from` on with the sign of the one before. Requires: from >= 1.
  constexpr void extend_sign(std::size_t from) {
    const std::uint64_t sign = mask_of_sign(limbs_[from - 1]);
    for (std::size_t i = from; i < Limbs; ++i) limbs_[i] = sign;
  }
  /// Subtracts 2^(64 Offset) times the unsigned number of the limbs of `other`, each AND `mask`.
  template <std::size_t Offset, std::size_t Others>
  constexpr void subtract_shifted(const WideInteger<Others>& other, std::uint64_t mask) {
    std::uint64_t borrow = 0;
    for (std::size_t i = Offset; i < Limbs; ++i) {
      const std::uint64_t taken = i - Offset < Others ? other.limbs_[i - Offset] & mask : 0;
      const UInt128 rest = UInt128{limbs_[i]} - taken - borrow;
      limbs_[i] = static_cast<std::uint64_t>(rest);
      borrow = static_cast<std::uint64_t>(rest >> 64) & 1;
    }
  }

  std::array<std::uint64_t, Limbs> limbs_{};
};

template <std::size_t Result, std::size_t A, std::size_t B>
constexpr WideInteger<Result> wide_product(const WideInteger<A>& a, const WideInteger<B>& b) {
  constexpr std::size_t kLimbs = std::min(Result, A + B);
  WideInteger<kLimbs> product;
  for (std::size_t i = 0; i < std::min(A, kLimbs); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < std::min(B, kLimbs - i); ++j) {
      const UInt128 sum = UInt128{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j] + carry;
      product.limbs_[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    if (i + B < kLimbs) product.limbs_[i + B] = carry;
  }
  // These were products of unsigned numbers: a negative factor was 2^(64 limbs) too large.
  if constexpr (A < kLimbs) {
    product.template subtract_shifted<A>(b, a.sign_mask());
  }
  if constexpr (B < kLimbs) {
    product.template subtract_shifted<B>(a, b.sign_mask());
  }
  return WideInteger<Result>(product);
}

template <std::size_t Limbs>
constexpr Sign sign_of(const WideInteger<Limbs>& value) {
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < Limbs; ++i) any |= value.limb(i);
  return static_cast<Sign>((any != 0 ? 1 : 0) - (value.is_negative() ? 2 : 0));
}

template <std::size_t Limbs>
mpz_class to_mpz(const WideInteger<Limbs>& value) {
  const bool negative = value.is_negative();
  const WideInteger<Limbs> magnitude = negative ? -value : value;  // as an unsigned number
  mpz_class result;
  mp_limb_t* limbs = mpz_limbs_write(result.get_mpz_t(), static_cast<mp_size_t>(Limbs));
  for (std::size_t i = 0; i < Limbs; ++i) limbs[i] = magnitude.limb(i);
  const auto size = static_cast<mp_size_t>(Limbs);
  mpz_limbs_finish(result.get_mpz_t(), negative ? -size : size);
  return result;
}

/// The double nearest to value * 2^-shift, up to one unit in the last place: 64 bits are kept
/// (relative error 2^-63) and rounded once; relative error at most 2u, where nothing underflows.
template <std::size_t Limbs>
double to_double_scaled(const WideInteger<Limbs>& value, long shift) {
  const bool negative = value.is_negative();
  const WideInteger<Limbs> magnitude = negative ? -value : value;
  std::size_t top = Limbs;
  while (top > 0 && magnitude.limb(top - 1) == 0) --top;
  if (top == 0) return 0;
  const int zeros = std::countl_zero(magnitude.limb(top - 1));
  std::uint64_t bits = magnitude.limb(top - 1) << zeros;
  if (zeros > 0 && top > 1) bits |= magnitude.limb(top - 2) >> (64 - zeros);
  const long power = static_cast<long>(64 * (top - 1)) - zeros - shift;
  const double result =
      std::ldexp(static_cast<double>(bits), static_cast<int>(std::clamp(power, -4000L, 4000L)));
  return negative ? -result : result;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_NUMBERS_WIDE_INTEGER_H
