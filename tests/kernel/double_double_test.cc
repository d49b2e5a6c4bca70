// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of doubles against rationals, and the nearest doubles that come from them.
#include "kernel/numbers/double_double.h"

#include <gtest/gtest.h>

#include <random>

#include "kernel/signs/nearest_double.h"

namespace gnomon {
namespace {

mpq_class exact(const DoubleDouble& value) { return mpq_class(value.high) + mpq_class(value.low); }
mpq_class power(int exponent) {
  return exponent >= 0 ? mpq_class(mpz_class(1) << static_cast<unsigned>(exponent))
                       : mpq_class(1, mpz_class(1) << static_cast<unsigned>(-exponent));
}
void expect_close(const mpq_class& value, const mpq_class& truth, int bits) {
  EXPECT_LE(abs(value - truth), power(-bits) * abs(truth)) << value << " for " << truth;
}

class Random {
 public:
  DoubleDouble pair() {
    const double high = std::ldexp(unit_(engine_), static_cast<int>(engine_() % 200) - 100);
    return two_sum(high, high * 0x1p-54 * unit_(engine_));
  }
  mpz_class integer(unsigned bits) {
    mpz_class value = 0;
    for (unsigned i = 0; i < bits; i += 32) value = (value << 32) + (engine_() & 0xffffffffu);
    value >>= (bits + 31) / 32 * 32 - bits;
    return engine_() % 2 == 0 ? value : mpz_class(-value);
  }

 private:
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

TEST(DoubleDouble, OperationsHaveTheirBounds) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const DoubleDouble a = random.pair(), b = random.pair();
    const mpq_class p = exact(a), q = exact(b);
    expect_close(exact(a * b), p * q, 102);
    if (q != 0) expect_close(exact(a / b), p / q, 101);
    EXPECT_LE(abs(exact(a + b) - (p + q)), power(-103) * (abs(p) + abs(q)));
    EXPECT_EQ(exact(two_product(a.high, b.high)), mpq_class(a.high) * mpq_class(b.high));
  }
}

TEST(DoubleDouble, SquareRoots) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    DoubleDouble a = random.pair();
    if (a.high < 0) a = -a;
    if (i % 4 == 0) a = double_double(mpz_class(random.integer(50) * random.integer(50)));
    if (!(a.high > 0)) continue;
    const mpq_class root = exact(square_root(a)), relative = root * root / exact(a) - 1;
    // (1 + e)^2 - 1 is 2e and a little.
    EXPECT_LE(abs(relative), power(-101) + power(-200)) << a.high << ' ' << a.low;
  }
  EXPECT_EQ(square_root({9, 0}).high, 3);
  EXPECT_EQ(square_root({9, 0}).low, 0);
}

TEST(DoubleDouble, IntegersOfEveryWidth) {
  Random random;
  for (unsigned bits = 1; bits <= 500; ++bits) {
    for (int i = 0; i < 20; ++i) {
      const mpz_class value = random.integer(bits);
      expect_close(exact(double_double(value)), value, 104);
      expect_close(exact(double_double(WideInteger<8>(value))), value, 104);
      if (bits <= 63) expect_close(exact(double_double(std::int64_t{value.get_si()})), value, 104);
      if (bits <= 125) expect_close(exact(double_double(integer_from<Int128>(value))), value, 104);
    }
  }
  const std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(exact(double_double(largest)), mpq_class(mpz_class(static_cast<long>(largest))));
}

TEST(DoubleDouble, NearestDoubleOrNothing) {
  Random random;
  int known = 0;
  for (int i = 0; i < 20000; ++i) {
    const mpq_class truth(random.integer(90), abs(random.integer(80)) + 1);
    const DoubleDouble value = double_double(truth);
    const auto nearest = nearest_double(value, 0x1p-95 * std::fabs(value.high));
    if (!nearest) continue;
    ++known;
    EXPECT_EQ(*nearest, nearest_double(truth));
  }
  EXPECT_GT(known, 19900);
  // A tie is not decided, however small the error; one next to it is.
  const double half_unit = 0x1p-53;
  EXPECT_FALSE(nearest_double(DoubleDouble{1, half_unit}, 0x1p-100));
  EXPECT_EQ(nearest_double(DoubleDouble{1, half_unit * (1 - 0x1p-30)}, 0x1p-100), 1.0);
  // A value that is a double is its own nearest.
  EXPECT_EQ(nearest_double(DoubleDouble{3, 0}, 0x1p-100), 3.0);
  // Where the bounds of the operations do not hold, nothing is said.
  EXPECT_FALSE(nearest_double(DoubleDouble{0x1p-900, 0}, 0));
  EXPECT_FALSE(nearest_double(DoubleDouble{INFINITY, 0}, 0));
  EXPECT_FALSE(nearest_double(DoubleDouble{1e-3, 0}, 1));
}

}  // namespace
}  // namespace gnomon
