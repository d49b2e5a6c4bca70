// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/decimal_text.h"

#include <gtest/gtest.h>

namespace gnomon::report {
namespace {

mpq_class power_of_two(long exponent) {
  mpq_class power = 1;
  const auto bits = static_cast<mp_bitcnt_t>(std::abs(exponent));
  exponent < 0 ? power >>= bits : power <<= bits;
  return power;
}

TEST(DecimalText, NumbersOfEverySize) {
  EXPECT_EQ(decimal_text(0), "0");
  EXPECT_EQ(decimal_text(1), "1e+00");
  EXPECT_EQ(decimal_text(-12), "-1.2e+01");
  EXPECT_EQ(decimal_text(mpq_class(1, 8)), "1.25e-01");
  EXPECT_EQ(decimal_text(power_of_two(-2000)), "8.7098098162172167e-603");
  EXPECT_EQ(decimal_text(power_of_two(2000), 5), "1.1481e+602");
}

TEST(DecimalText, RoundsToTheNearestDigit) {
  EXPECT_EQ(decimal_text(mpq_class(2, 3), 3), "6.67e-01");
  EXPECT_EQ(decimal_text(mpq_class(1, 3), 3), "3.33e-01");
  EXPECT_EQ(decimal_text(mpq_class(99951, 100), 4), "9.995e+02");
  EXPECT_EQ(decimal_text(mpq_class(99996, 100), 4), "1e+03");
  EXPECT_EQ(decimal_text(mpq_class(99996, 10'000'000), 4), "1e-02");
  EXPECT_EQ(decimal_text(mpq_class(1000), 4), "1e+03");
}

TEST(DecimalText, PowersOfTenAreNotMissedByOne) {
  mpz_class power = 1;
  for (int exponent = 0; exponent < 700; ++exponent, power *= 10) {
    EXPECT_EQ(decimal_text(power).front(), '1');
    EXPECT_EQ(decimal_text(mpq_class(1, power)).front(), '1');
    EXPECT_EQ(decimal_text(power - 1, 3).front(), exponent == 0 ? '0' : exponent > 3 ? '1' : '9');
  }
}

}  // namespace
}  // namespace gnomon::report
