// SPDX-License-Identifier: LGPL-3.0-or-later
// The integers of the exact stage, from 64 bits to unbounded, and the determinants that decide.
//
// The same source is compiled for each; the precision plan (precision_plan.h) says which is wide
// enough for a scene and a predicate, and with_width() goes from the one to the other. Vectors may
// be kept in narrower integers than the products of their components need: cross<Result>(),
// dot<Result>() and sign_of_determinant<Int>() form each product in the narrowest type that holds
// it.
//
// Exactness: exact as long as no intermediate exceeds the type, which the plan's bounds guarantee
// (docs/exactness.md; tests drive each width to its last bit).
#ifndef GNOMON_KERNEL_NUMBERS_EXACT_INTEGER_H
#define GNOMON_KERNEL_NUMBERS_EXACT_INTEGER_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "gnomon/kernel/precision_plan.h"
#include "gnomon/kernel/sign.h"
#include "kernel/numbers/wide_integer.h"

namespace gnomon {

using Int256 = WideInteger<4>;
using Int512 = WideInteger<8>;
using Int1024 = WideInteger<16>;

/// Limbs of 64 bits; 0: unbounded.
template <class Int>
inline constexpr std::size_t kLimbsOf = 0;
template <>
inline constexpr std::size_t kLimbsOf<std::int64_t> = 1;
template <>
inline constexpr std::size_t kLimbsOf<Int128> = 2;
template <std::size_t Limbs>
inline constexpr std::size_t kLimbsOf<WideInteger<Limbs>> = Limbs;

/// The integer type of so many limbs: std::int64_t, Int128, or a WideInteger.
template <std::size_t Limbs>
using FixedInteger = std::conditional_t<Limbs == 1, std::int64_t,
                                        std::conditional_t<Limbs == 2, Int128, WideInteger<Limbs>>>;

/// Calls f.template operator()<Int>() with the integers of that width: std::int64_t, Int128,
/// Int256, Int512, Int1024 or mpz_class.
template <class F>
decltype(auto) with_width(IntegerWidth width, F&& f) {
  switch (width) {
    case IntegerWidth::k64:
      return f.template operator()<std::int64_t>();
    case IntegerWidth::k128:
      return f.template operator()<Int128>();
    case IntegerWidth::k256:
      return f.template operator()<Int256>();
    case IntegerWidth::k512:
      return f.template operator()<Int512>();
    case IntegerWidth::k1024:
      return f.template operator()<Int1024>();
    case IntegerWidth::kUnbounded:
      break;
  }
  return f.template operator()<mpz_class>();
}

/// Calls f.template operator()<Factor, Int>(): Int as with_width() has it, and Factor the narrowest
/// type, at most Int, in which vectors with components below 2^factor_bits may be kept for
/// determinant<Int>(): std::int64_t, Int128, 192 bits, 256 bits, 384 bits or Int.
template <class F>
decltype(auto) with_widths(IntegerWidth width, unsigned factor_bits, F&& f) {
  return with_width(width, [&]<class Int>() {
    constexpr std::size_t kLimbs = kLimbsOf<Int>;
    if constexpr (kLimbs == 2 || kLimbs == 4) {
      if (factor_bits <= 62) return f.template operator()<std::int64_t, Int>();
    }
    if constexpr (kLimbs >= 4) {
      if (factor_bits <= 126) return f.template operator()<Int128, Int>();
    }
    if constexpr (kLimbs >= 8) {
      if (factor_bits <= 190) return f.template operator()<WideInteger<3>, Int>();
    }
    if constexpr (kLimbs == 16) {
      if (factor_bits <= 254) return f.template operator()<WideInteger<4>, Int>();
      if (factor_bits <= 382) return f.template operator()<WideInteger<6>, Int>();
    }
    return f.template operator()<Int, Int>();
  });
}

/// Calls f.template operator()<Factor>() with the narrowest of these types, at most Int, that holds
/// values below 2^factor_bits and twice that, with a sign. Requires: Int is of fixed width.
template <class Int, class F>
decltype(auto) with_factor(unsigned factor_bits, F&& f) {
  constexpr std::size_t kLimbs = kLimbsOf<Int>;
  if constexpr (kLimbs > 1) {
    if (factor_bits <= 62) return f.template operator()<std::int64_t>();
  }
  if constexpr (kLimbs > 2) {
    if (factor_bits <= 126) return f.template operator()<Int128>();
  }
  if constexpr (kLimbs > 3) {
    if (factor_bits <= 190) return f.template operator()<WideInteger<3>>();
  }
  if constexpr (kLimbs > 4) {
    if (factor_bits <= 254) return f.template operator()<WideInteger<4>>();
  }
  return f.template operator()<Int>();
}

template <class Int>
using Vector3 = std::array<Int, 3>;

template <class Int>
Int integer_from(std::int64_t value) {
  return Int(static_cast<long>(value));
}
/// Requires: `value` fits into Int.
template <class Int>
Int integer_from(const Int128& value) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return to_mpz(WideInteger<2>(value));
  } else {
    return static_cast<Int>(value);
  }
}
/// Requires: `value` fits into Int.
template <class Int>
Int integer_from(const mpz_class& value) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return value;
  } else if constexpr (std::is_same_v<Int, std::int64_t>) {
    return value.get_si();
  } else if constexpr (std::is_same_v<Int, Int128>) {
    const WideInteger<2> wide(value);
    return static_cast<Int128>(UInt128{wide.limb(1)} << 64 | wide.limb(0));
  } else {
    return Int(value);
  }
}

/// The type of a b: as wide as the two factors together, but not wider than Int.
template <class Int, class A, class B>
using Product =
    std::conditional_t<kLimbsOf<Int> == 0, mpz_class,
                       FixedInteger<std::min(kLimbsOf<Int>, kLimbsOf<A> + kLimbsOf<B>)>>;

/// a b. Requires: it fits into Result.
template <class Result, class A, class B>
Result multiply(const A& a, const B& b) {
  if constexpr (kLimbsOf<Result> == 0) {
    return a * b;
  } else if constexpr (kLimbsOf<Result> <= 2) {
    return static_cast<Result>(a) * static_cast<Result>(b);
  } else {
    return wide_product<kLimbsOf<Result>>(WideInteger<kLimbsOf<A>>(a), WideInteger<kLimbsOf<B>>(b));
  }
}

/// Requires: every sum of two products fits into Result.
template <class Result, class A, class B>
Vector3<Result> cross(const Vector3<A>& a, const Vector3<B>& b) {
  return {Result(multiply<Result>(a[1], b[2]) - multiply<Result>(a[2], b[1])),
          Result(multiply<Result>(a[2], b[0]) - multiply<Result>(a[0], b[2])),
          Result(multiply<Result>(a[0], b[1]) - multiply<Result>(a[1], b[0]))};
}
template <class Int>
Vector3<Int> cross(const Vector3<Int>& a, const Vector3<Int>& b) {
  return cross<Int, Int, Int>(a, b);
}
/// Requires: every partial sum fits into Result.
template <class Result, class A, class B>
Result dot(const Vector3<A>& a, const Vector3<B>& b) {
  return Result(multiply<Result>(a[0], b[0]) + multiply<Result>(a[1], b[1]) +
                multiply<Result>(a[2], b[2]));
}
template <class Int>
Int dot(const Vector3<Int>& a, const Vector3<Int>& b) {
  return dot<Int, Int, Int>(a, b);
}
/// Requires: it fits.
template <class Int>
Vector3<Int> difference(const Vector3<Int>& a, const Vector3<Int>& b) {
  return {Int(a[0] - b[0]), Int(a[1] - b[1]), Int(a[2] - b[2])};
}
/// a . (b x c), its cross product and itself formed in the narrowest types that hold them.
/// Requires: side_of_crossing_bits() of the components' magnitude bits fit into Int, and each
/// component leaves two bits of its own type free, |x| < 2^(64 limbs - 2), so that the product of
/// three types holds the sum of the six products (unless the type is Int itself).
template <class Int, class A, class B, class C>
Int determinant(const Vector3<A>& a, const Vector3<B>& b, const Vector3<C>& c) {
  using Term = Product<Int, B, C>;
  return Int(dot<Product<Int, A, Term>>(a, cross<Term>(b, c)));
}
/// Its sign.
template <class Int, class A, class B, class C>
Sign sign_of_determinant(const Vector3<A>& a, const Vector3<B>& b, const Vector3<C>& c) {
  using Term = Product<Int, B, C>;
  return sign_of(dot<Product<Int, A, Term>>(a, cross<Term>(b, c)));
}
template <class Int>
Sign sign_of_determinant(const Vector3<Int>& a, const Vector3<Int>& b, const Vector3<Int>& c) {
  return sign_of_determinant<Int, Int, Int, Int>(a, b, c);
}
template <>
inline constexpr Sign sign_of(const Int128& value) {
  return value > 0 ? Sign::kPositive : value < 0 ? Sign::kNegative : Sign::kZero;
}
template <>
inline Sign sign_of(const mpz_class& value) {
  return static_cast<Sign>(sgn(value));
}

/// The double nearest to value * 2^-shift, rounded once: relative error at most u, where nothing
/// underflows.
inline double to_double_scaled(std::int64_t value, long shift) {
  return std::ldexp(static_cast<double>(value), static_cast<int>(-shift));
}
inline double to_double_scaled(Int128 value, long shift) {
  return std::ldexp(static_cast<double>(value), static_cast<int>(-shift));
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

#endif  // GNOMON_KERNEL_NUMBERS_EXACT_INTEGER_H
