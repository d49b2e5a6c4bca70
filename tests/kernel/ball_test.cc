// SPDX-License-Identifier: GPL-3.0-or-later
// A Ball encloses: random expressions are evaluated in balls and in rationals, at every magnitude
// that doubles have.
#include "kernel/signs/ball.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "scene/base/random.h"

namespace gnomon::test {
namespace {

bool encloses(const Ball& ball, const mpq_class& exact) {
  if (!std::isfinite(ball.radius) || !std::isfinite(ball.middle)) return true;  // says nothing
  return abs(mpq_class(ball.middle) - exact) <= mpq_class(ball.radius);
}

double random_double(Random& random, int reach) {
  if (random.chance(1, 12)) return 0;
  const auto mantissa =
      static_cast<double>(random.between(-(std::int64_t{1} << 53), std::int64_t{1} << 53));
  return std::ldexp(mantissa, static_cast<int>(random.between(-reach, reach)) - 53);
}

struct Term {
  Ball ball;
  mpq_class exact;
};

/// An operand with a radius of its own, and a true value somewhere in it.
Term random_term(Random& random, int reach) {
  Term term;
  const double middle = random_double(random, reach);
  term.exact = middle;
  double radius = 0;
  if (random.chance(1, 2)) {
    radius = std::fabs(std::ldexp(middle, -static_cast<int>(random.between(1, 60))));
    const mpq_class part(random.between(-100, 100), 100);
    term.exact += mpq_class(radius) * mpq_class(part.get_num(), part.get_den());
  }
  term.ball = Ball(middle, radius);
  return term;
}

void check_expressions(int reach, std::uint64_t seed) {
  Random random(seed);
  int informative = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<Term> terms{random_term(random, reach)};
    for (int step = 0; step < 5; ++step) {
      const Term other =
          random.chance(1, 2) ? random_term(random, reach) : terms[random.below(terms.size())];
      Term term = terms.back();
      switch (random.below(5)) {
        case 0:
          term = {term.ball + other.ball, term.exact + other.exact};
          break;
        case 1:
          term = {term.ball - other.ball, term.exact - other.exact};
          break;
        case 2:
          term = {term.ball * other.ball, term.exact * other.exact};
          break;
        case 3:
          term = {-term.ball, -term.exact};
          break;
        default:
          if (other.exact == 0) {
            EXPECT_FALSE((term.ball / other.ball).is_finite());
            continue;
          }
          term = {term.ball / other.ball, term.exact / other.exact};
      }
      ASSERT_TRUE(encloses(term.ball, term.exact))
          << "round " << round << ": " << term.ball.middle << " +- " << term.ball.radius << ", but "
          << term.exact.get_d();
      if (!term.ball.is_finite()) break;
      ++informative;
      ASSERT_LE(mpq_class(term.ball.lower()), term.exact);
      ASSERT_GE(mpq_class(term.ball.upper()), term.exact);
      terms.push_back(term);
    }
  }
  EXPECT_GT(informative, 20000);
}

TEST(Ball, EnclosesAtOrdinaryMagnitudes) { check_expressions(30, 1); }
TEST(Ball, EnclosesAtLargeAndSmallMagnitudes) { check_expressions(300, 2); }
TEST(Ball, EnclosesWhereDoublesEnd) { check_expressions(1020, 3); }

TEST(Ball, EnclosesSubnormals) {
  Random random(4);
  for (int round = 0; round < 20000; ++round) {
    const double a = std::ldexp(static_cast<double>(random.between(-1000, 1000)), -1074);
    const double b = std::ldexp(static_cast<double>(random.between(-1000, 1000)), -60);
    ASSERT_TRUE(encloses(Ball(a) * Ball(b), mpq_class(a) * mpq_class(b)));
    ASSERT_TRUE(encloses(Ball(a) + Ball(b), mpq_class(a) + mpq_class(b)));
    if (b == 0) continue;
    ASSERT_TRUE(encloses(Ball(a) / Ball(b), mpq_class(a) / mpq_class(b)));
  }
}

TEST(Ball, IsNarrow) {
  // One operation on exact operands costs a few units in the last place, not more.
  const Ball third = Ball(1.0) / Ball(3.0);
  EXPECT_LT(third.radius, 0x1p-53);
  EXPECT_TRUE(encloses(third, mpq_class(1, 3)));
  EXPECT_EQ((Ball(2.0) * Ball(3.0)).middle, 6.0);
  EXPECT_FALSE((Ball(1.0) / Ball(0.5, 0.5)).is_finite());
  EXPECT_FALSE((Ball(std::numeric_limits<double>::max()) * Ball(2.0)).is_finite());
}

}  // namespace
}  // namespace gnomon::test
