// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/enclosure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::oracle {
namespace {

TEST(Enclosure, ExactDoublesAreSinglePoints) {
  for (double value : {0.0, 1.0, -0.375, 0x1p-1074, 1.7976931348623157e308}) {
    const Enclosure found = enclose(mpq_class(value));
    EXPECT_EQ(found.lower, value);
    EXPECT_EQ(found.upper, value);
  }
}

TEST(Enclosure, RationalsLieBetweenNeighbours) {
  for (int sign : {-1, 1}) {
    const mpq_class third(sign, 3);
    const Enclosure found = enclose(third);
    EXPECT_LT(mpq_class(found.lower), third);
    EXPECT_GT(mpq_class(found.upper), third);
    EXPECT_EQ(std::nextafter(found.lower, 1), found.upper);
  }
}

TEST(Enclosure, BeyondDoubles) {
  const mpz_class huge = mpz_class(1) << 2000;
  EXPECT_TRUE(std::isinf(enclose(huge).upper));
  EXPECT_TRUE(std::isfinite(enclose(huge).lower));
  EXPECT_EQ(enclose(mpq_class(1, huge)).lower, 0.0);
  EXPECT_GT(enclose(mpq_class(1, huge)).upper, 0.0);
}

TEST(Enclosure, SumsOfManyTermsHoldTheExactSum) {
  Enclosure sum;
  mpq_class exact;
  for (int i = 1; i <= 1000; ++i) {
    const mpq_class term(1, i);
    sum = sum + enclose(term);
    exact += term;
  }
  EXPECT_LE(mpq_class(sum.lower), exact);
  EXPECT_GE(mpq_class(sum.upper), exact);
  EXPECT_LT(sum.upper - sum.lower, 1e-11);
}

TEST(Enclosure, RootsOfAnySize) {
  for (int power : {-3000, -1000, -1, 0, 1, 7, 1000}) {
    mpq_class value = 2;
    mpz_class scale = mpz_class(1) << (2 * std::abs(power));
    if (power < 0) {
      value /= scale;
    } else {
      value *= scale;
    }
    const Enclosure root = enclose_square_root(value);
    EXPECT_LE(mpq_class(root.lower) * mpq_class(root.lower), value) << power;
    EXPECT_GE(mpq_class(root.upper) * mpq_class(root.upper), value) << power;
  }
}

}  // namespace
}  // namespace gnomon::oracle
