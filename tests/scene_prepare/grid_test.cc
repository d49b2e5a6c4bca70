// SPDX-License-Identifier: GPL-3.0-or-later
// The grid is exact and as coarse as can be, whichever integers it is made with: coordinates of all
// widths, those at the limits of 64 and 128 bits above all.
#include "gnomon/scene/grid.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace gnomon {
namespace {

mpz_class random_integer(std::mt19937_64& random, unsigned bits) {
  mpz_class value = 0;
  for (unsigned taken = 0; taken < bits; taken += 64) {
    value <<= 64;
    value += static_cast<unsigned long>(random());
  }
  mpz_class result;
  mpz_fdiv_r_2exp(result.get_mpz_t(), value.get_mpz_t(), bits);
  mpz_setbit(result.get_mpz_t(), bits - 1);
  return random() % 2 == 0 ? result : mpz_class(-result);
}

void expect_exact(const std::vector<Position>& positions) {
  std::vector<const Position*> points;
  for (const Position& position : positions) points.push_back(&position);
  const ExactGrid grid = make_grid(points);
  mpz_class step = 0, largest = 0;
  std::array<mpz_class, 3> low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const mpz_class at = grid.at(i, k);
      EXPECT_EQ(grid.origin[axis] + grid.step * mpq_class(at), positions[i][axis].exact());
      EXPECT_GE(at, 0);
      step = gcd(step, at);
      largest = std::max(largest, at);
      low[axis] = i == 0 ? at : std::min(low[axis], at);
    }
  }
  EXPECT_LE(step, 1);
  EXPECT_EQ(low, (std::array<mpz_class, 3>{0, 0, 0}));
  EXPECT_EQ(grid.bits, largest == 0 ? 0 : mpz_sizeinbase(largest.get_mpz_t(), 2));
  EXPECT_EQ(grid.is_narrow, grid.bits <= 63);
}

TEST(Grid, ExactWithIntegersOfEveryWidth) {
  std::mt19937_64 random(58);
  for (unsigned bits = 1; bits <= 140; ++bits) {
    for (int kind = 0; kind < 6; ++kind) {
      // Two points of that width, others shorter, all over one unit: as 2^e, as 10^e, or times a
      // common factor.
      const mpz_class factor = kind % 3 == 2 ? 3 * 1000003 : 1;
      const auto number = [&](unsigned width) {
        const mpz_class mantissa = factor * random_integer(random, width);
        const int exponent = kind < 3 ? -7 : 5;
        return kind % 2 == 0 ? Number::from_dyadic(mantissa, exponent)
                             : Number::from_decimal(mantissa, exponent);
      };
      std::vector<Position> positions;
      for (int i = 0; i < 6; ++i) {
        const unsigned width = i < 2 ? bits : 1 + static_cast<unsigned>(random() % bits);
        positions.push_back({number(width), number(width), number(width)});
      }
      expect_exact(positions);
      if (::testing::Test::HasFailure()) FAIL() << bits << " bits, kind " << kind;
    }
  }
}

TEST(Grid, ExactWithMantissasThatFitAndExponentsFarApart) {
  for (const bool decimal : {false, true}) {
    const auto number = [&](long mantissa, std::int32_t exponent) {
      return decimal ? Number::from_decimal(mantissa, exponent)
                     : Number::from_dyadic(mantissa, exponent);
    };
    for (std::int32_t exponent = 0; exponent <= 130; ++exponent) {
      for (const long mantissa : {1L, -1L, 7L, 999999999999999999L, -9007199254740991L}) {
        expect_exact({{number(mantissa, exponent), number(0, 0), number(1, 0)},
                      {number(-mantissa, exponent), number(1, 0), number(1, 0)},
                      {number(0, 0), number(mantissa, exponent / 2), number(-3, 0)}});
        if (::testing::Test::HasFailure()) FAIL() << mantissa << ", exponent " << exponent;
      }
    }
  }
}

TEST(Grid, BothBasesAndPointsThatCoincide) {
  const Number half(0.5), tenth = Number::from_decimal(1, -1);
  expect_exact({{half, tenth, half}, {tenth, half, tenth}});
  expect_exact({{half, tenth, half}, {half, tenth, half}});
  expect_exact({{Number(), Number(), Number()}, {Number(), Number(), Number()}});
}

}  // namespace
}  // namespace gnomon
