// SPDX-License-Identifier: GPL-3.0-or-later
// Rationals to doubles: the nearest one at ties, among subnormal numbers and at the end of the
// range, and enclosures that hold.
#include "kernel/signs/nearest_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/base/random.h"

namespace gnomon::test {
namespace {

mpq_class power_of_two(long exponent) {
  return exponent < 0 ? mpq_class(1, mpz_class(1) << -exponent)
                      : mpq_class(mpz_class(1) << exponent);
}

TEST(NearestDouble, NothingIsNearer) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const long scale = std::array{0L, -1075L, -1070L, -1000L, 400L, 960L}[random.below(6)];
    mpq_class value(static_cast<long>(random.between(-1'000'000'000'000, 1'000'000'000'000)),
                    static_cast<long>(random.below(std::uint64_t{1} << random.below(62)) + 1));
    value.canonicalize();
    value *= power_of_two(scale);
    const double nearest = nearest_double(value);
    ASSERT_TRUE(std::isfinite(nearest));
    const mpq_class distance = abs(value - mpq_class(nearest));
    for (const double towards : {-INFINITY, INFINITY}) {
      const double other = std::nextafter(nearest, towards);
      if (std::isinf(other)) continue;
      ASSERT_LE(distance, abs(value - mpq_class(other))) << value;
    }
    const Ball ball = enclose(value);
    ASSERT_LE(abs(value - mpq_class(ball.middle)), mpq_class(ball.radius)) << value;
  }
}

TEST(NearestDouble, TiesGoToTheEvenOne) {
  for (const double even : {1.0, 3.0 - 0x1p-50, 0.0, 0x1p-1073, 0x1p-1022, 0x1p1000}) {
    const double odd = std::nextafter(even, INFINITY);
    const mpq_class above = (mpq_class(even) + mpq_class(odd)) / 2;
    EXPECT_EQ(nearest_double(above), even);
    EXPECT_EQ(nearest_double(-above), -even);
    const double next = std::nextafter(odd, INFINITY);
    EXPECT_EQ(nearest_double((mpq_class(odd) + mpq_class(next)) / 2), next);
  }
}

TEST(NearestDouble, RangeEndsHalfwayToTheNextPowerOfTwo) {
  const double largest = std::numeric_limits<double>::max();
  const mpq_class halfway = (mpq_class(largest) + power_of_two(1024)) / 2;
  EXPECT_EQ(nearest_double(halfway - 1), largest);
  EXPECT_EQ(nearest_double(halfway), INFINITY);
  EXPECT_EQ(nearest_double(-halfway), -INFINITY);
  EXPECT_EQ(nearest_double(power_of_two(1024)), INFINITY);
  EXPECT_EQ(nearest_double(power_of_two(100000)), INFINITY);
  EXPECT_EQ(nearest_double(power_of_two(-100000)), 0.0);
  EXPECT_FALSE(enclose(power_of_two(1024)).is_finite());
}

}  // namespace
}  // namespace gnomon::test
