// SPDX-License-Identifier: GPL-3.0-or-later
// The fixed-width integers against GMP: every operation, at every width, on operands where carries,
// borrows and signs go wrong if they ever do (all ones, 2^k, 2^k - 1, alternating bits, the least
// and the greatest number), and what happens one past the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "kernel/numbers/exact_integer.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

mpz_class power_of_two(unsigned k) { return mpz_class(1) << k; }

/// The number in [-2^(bits-1), 2^(bits-1)) that is congruent to `value` modulo 2^bits.
mpz_class wrapped(const mpz_class& value, unsigned bits) {
  mpz_class result;
  mpz_fdiv_r_2exp(result.get_mpz_t(), value.get_mpz_t(), bits);
  return result >= power_of_two(bits - 1) ? mpz_class(result - power_of_two(bits)) : result;
}

bool fits(const mpz_class& value, unsigned bits) { return wrapped(value, bits) == value; }

/// An operand of `bits` signed bits, most often at a limit of the type or of a limb.
mpz_class tricky(Random& random, unsigned bits) {
  const auto k = static_cast<unsigned>(random.below(bits));
  mpz_class value;
  switch (random.below(8)) {
    case 0:
      value = power_of_two(bits - 1) - 1;
      break;
    case 1:
      return -power_of_two(bits - 1);
    case 2:
      value = power_of_two(k) - 1;
      break;
    case 3:
      value = power_of_two(k);
      break;
    case 4:  // 0101...
      value = (power_of_two(2 * ((k + 1) / 2)) - 1) / 3;
      break;
    case 5:  // runs of whole limbs of ones and zeros
      for (unsigned i = 0; i < bits; i += 64) {
        value <<= 64;
        if (random.chance(1, 2)) value += power_of_two(64) - 1;
      }
      break;
    case 6:
      value = static_cast<unsigned long>(random.below(4));
      break;
    default:
      value = random_bits(random, k + 1);
      break;
  }
  value += static_cast<long>(random.between(-2, 2));
  if (random.chance(1, 2)) value = -value;
  return wrapped(value, bits);
}

template <class Wide>
class WideIntegerTest : public testing::Test {};
using Widths = testing::Types<WideInteger<1>, WideInteger<2>, WideInteger<3>, Int256,
                              WideInteger<6>, Int512, Int1024>;
struct WidthNames {
  template <class Wide>
  static std::string GetName(int) {
    return std::to_string(8 * sizeof(Wide)) + "_bits";
  }
};
TYPED_TEST_SUITE(WideIntegerTest, Widths, WidthNames);

constexpr int kRounds = 20000;

TYPED_TEST(WideIntegerTest, IsPlainData) {
  static_assert(std::is_trivially_copyable_v<TypeParam>);
  static_assert(sizeof(TypeParam) == 8 * TypeParam::kLimbs);
  EXPECT_EQ(sign_of(TypeParam()), Sign::kZero);
}

TYPED_TEST(WideIntegerTest, EveryOperationIsGmpsModuloTheWidth) {
  constexpr unsigned kBits = TypeParam::kBits;
  Random random(kBits);
  int sums_beyond = 0, products_beyond = 0;
  for (int round = 0; round < kRounds; ++round) {
    const mpz_class a = tricky(random, kBits), b = tricky(random, kBits);
    const TypeParam x(a), y(b);
    ASSERT_EQ(to_mpz(x), a);
    ASSERT_EQ(to_mpz(x + y), wrapped(a + b, kBits));
    ASSERT_EQ(to_mpz(x - y), wrapped(a - b, kBits));
    ASSERT_EQ(to_mpz(-x), wrapped(-a, kBits));
    ASSERT_EQ(to_mpz(x * y), wrapped(a * b, kBits));
    ASSERT_EQ(x == y, a == b);
    ASSERT_EQ(static_cast<int>(sign_of(x)), sgn(a));
    ASSERT_EQ(x.is_negative(), a < 0);
    sums_beyond += fits(a + b, kBits) ? 0 : 1;
    products_beyond += fits(a * b, kBits) ? 0 : 1;
  }
  // Both sides of the limit were seen.
  EXPECT_GT(sums_beyond, kRounds / 100);
  EXPECT_GT(products_beyond, kRounds / 100);
  EXPECT_LT(products_beyond, kRounds - kRounds / 100);
}

TYPED_TEST(WideIntegerTest, ConvertsBetweenWidths) {
  Random random(TypeParam::kBits);
  for (int round = 0; round < kRounds / 4; ++round) {
    const mpz_class a = tricky(random, TypeParam::kBits);
    const TypeParam x(a);
    ASSERT_EQ(to_mpz(WideInteger<17>(x)), a);
    ASSERT_EQ(to_mpz(WideInteger<1>(x)), wrapped(a, 64));
    ASSERT_EQ(to_mpz(Int256(x)), wrapped(a, 256));
    const mpz_class small = tricky(random, 64), middle = tricky(random, 128);
    ASSERT_EQ(to_mpz(TypeParam(std::int64_t{small.get_si()})), small);
    ASSERT_EQ(to_mpz(TypeParam(integer_from<Int128>(middle))), wrapped(middle, TypeParam::kBits));
    ASSERT_EQ(to_mpz(TypeParam(middle << 900)), wrapped(middle << 900, TypeParam::kBits));
  }
}

TYPED_TEST(WideIntegerTest, DoubleIsWithinTwoRoundings) {
  Random random(TypeParam::kBits);
  for (int round = 0; round < kRounds / 4; ++round) {
    const mpz_class a = tricky(random, TypeParam::kBits);
    const auto shift = static_cast<long>(random.between(-30, TypeParam::kBits + 10));
    const double value = to_double_scaled(TypeParam(a), shift);
    mpq_class exact(a);
    if (shift >= 0) {
      exact /= power_of_two(static_cast<unsigned>(shift));
    } else {
      exact *= power_of_two(static_cast<unsigned>(-shift));
    }
    if (!std::isfinite(value)) {  // only where the true value is beyond the doubles
      ASSERT_GE(abs(exact), power_of_two(1024) - power_of_two(970)) << a;
      continue;
    }
    ASSERT_LE(abs(mpq_class(value) - exact), abs(exact) / power_of_two(52)) << a;
  }
  EXPECT_EQ(to_double_scaled(TypeParam(std::int64_t{-3}), 1), -1.5);
  EXPECT_EQ(to_double_scaled(TypeParam(), 7), 0);
}

TEST(WideInteger, ScalesBeyondTheDoublesWithoutWrappingAround) {
  const Int1024 one(std::int64_t{1});
  EXPECT_EQ(to_double_scaled(one, 1L << 40), 0);
  EXPECT_EQ(to_double_scaled(-one, -(1L << 40)), -HUGE_VAL);
}

/// Products of A and B limbs into 1 ... A + B + 1 limbs.
template <std::size_t A, std::size_t B, std::size_t Result = A + B + 1>
void check_mixed_product(Random& random) {
  for (int round = 0; round < kRounds / 10; ++round) {
    const mpz_class a = tricky(random, 64 * A), b = tricky(random, 64 * B);
    const mpz_class product = to_mpz(wide_product<Result>(WideInteger<A>(a), WideInteger<B>(b)));
    ASSERT_EQ(product, wrapped(a * b, 64 * Result))
        << A << " x " << B << " limbs into " << Result << ": " << a << " times " << b;
    if (Result >= A + B) {
      ASSERT_EQ(product, a * b);
    }
  }
  if constexpr (Result > 1) check_mixed_product<A, B, Result - 1>(random);
}

TEST(WideInteger, ProductsOfMixedWidths) {
  Random random(3);
  check_mixed_product<1, 1>(random);
  check_mixed_product<1, 2>(random);
  check_mixed_product<2, 1>(random);
  check_mixed_product<2, 2>(random);
  check_mixed_product<2, 4>(random);
  check_mixed_product<3, 3>(random);
  check_mixed_product<3, 6>(random);
  check_mixed_product<4, 4>(random);
  check_mixed_product<5, 2>(random);
  check_mixed_product<6, 12>(random);
}

TEST(WideInteger, IsConstant) {
  constexpr Int256 kThree(std::int64_t{3});
  constexpr Int256 kMinusSix = kThree * Int256(std::int64_t{-2});
  static_assert(kMinusSix + kThree == -kThree);
  static_assert(sign_of(kMinusSix) == Sign::kNegative &&
                sign_of(kMinusSix - kMinusSix) == Sign::kZero);
  static_assert(wide_product<3>(WideInteger<1>(std::int64_t{-1}), kThree) ==
                WideInteger<3>(std::int64_t{-3}));
}

TEST(ExactInteger, FromGmpToEveryWidth) {
  Random random(11);
  for (int round = 0; round < kRounds / 4; ++round) {
    const mpz_class small = tricky(random, 64), middle = tricky(random, 128),
                    large = tricky(random, 512);
    ASSERT_EQ(mpz_class(static_cast<long>(integer_from<std::int64_t>(small))), small);
    ASSERT_EQ(to_mpz(WideInteger<2>(integer_from<Int128>(middle))), middle);
    ASSERT_EQ(to_mpz(integer_from<Int512>(large)), large);
    ASSERT_EQ(integer_from<mpz_class>(large), large);
  }
}

/// Magnitudes below 2^bits, mostly the very largest, with every pattern of signs.
Integers extreme(Random& random, unsigned bits) {
  Integers v;
  for (mpz_class& x : v) {
    x = random.chance(1, 8) ? random_bits(random, bits) : mpz_class(power_of_two(bits) - 1);
    if (random.chance(1, 2)) x = -x;
  }
  return v;
}

template <class Int>
Vector3<Int> vector_from(const Integers& v) {
  return {integer_from<Int>(v[0]), integer_from<Int>(v[1]), integer_from<Int>(v[2])};
}

/// Components of A, B, C bits in the narrow types, the determinant in Int or as wide as they need.
template <class Int, class A, class B, class C>
void check_determinant(unsigned a_bits, unsigned b_bits, unsigned c_bits) {
  Random random(a_bits + b_bits + c_bits);
  int zeros = 0;
  for (int round = 0; round < 2000; ++round) {
    const Integers a = extreme(random, a_bits), b = extreme(random, b_bits),
                   c = random.chance(1, 4) && b_bits == c_bits ? b : extreme(random, c_bits);
    const mpz_class exact = test::dot(a, test::cross(b, c));
    zeros += exact == 0 ? 1 : 0;
    ASSERT_EQ(static_cast<int>(sign_of_determinant<Int>(vector_from<A>(a), vector_from<B>(b),
                                                        vector_from<C>(c))),
              sgn(exact));
  }
  EXPECT_GT(zeros, 0);
}

TEST(ExactInteger, DeterminantsOfNarrowVectors) {
  using Int64 = std::int64_t;
  // Two bits to spare in each type: as wide as the three factors together.
  check_determinant<Int256, Int64, Int64, Int64>(62, 62, 62);
  check_determinant<Int512, Int128, Int128, Int128>(126, 126, 126);
  check_determinant<Int1024, Int256, Int256, Int256>(254, 254, 254);
  check_determinant<Int512, Int64, Int128, Int128>(62, 126, 126);
  check_determinant<Int1024, Int256, Int128, Int64>(254, 126, 62);
  // Limited by Int, which side_of_crossing_bits() must fit.
  check_determinant<Int128, Int64, Int64, Int64>(41, 41, 41);
  check_determinant<Int256, Int128, Int128, Int128>(84, 84, 84);
  check_determinant<Int512, Int256, Int256, Int256>(169, 169, 169);
  check_determinant<mpz_class, mpz_class, mpz_class, mpz_class>(300, 300, 300);
}

TEST(ExactInteger, WithWidthPassesTheType) {
  const auto limbs = [](IntegerWidth width) {
    return with_width(width, []<class Int>() { return kLimbsOf<Int>; });
  };
  EXPECT_EQ(limbs(IntegerWidth::k64), 1u);
  EXPECT_EQ(limbs(IntegerWidth::k128), 2u);
  EXPECT_EQ(limbs(IntegerWidth::k256), 4u);
  EXPECT_EQ(limbs(IntegerWidth::k512), 8u);
  EXPECT_EQ(limbs(IntegerWidth::k1024), 16u);
  EXPECT_EQ(limbs(IntegerWidth::kUnbounded), 0u);
}

}  // namespace
}  // namespace gnomon::test
