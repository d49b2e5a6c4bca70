// SPDX-License-Identifier: GPL-3.0-or-later
// Image spaces without CGAL; image_space_epeck_test.cc has the others.
#include "image_space_test.h"

#include "gnomon/kernel/image_precision.h"
#include "kernel/coordinate/coordinate_image_space.h"
#include "kernel/implicit/implicit_image_space.h"

namespace gnomon::test {

using Spaces = testing::Types<CoordinateImageSpace<float>, CoordinateImageSpace<double>,
                              CoordinateImageSpace<long double>, CoordinateImageSpace<mpq_class>,
                              ImplicitImageSpace<>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Plain, ImageSpaceOf, Spaces);
using ExactSpaces = testing::Types<CoordinateImageSpace<mpq_class>, ImplicitImageSpace<>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Plain, ExactImageSpaceOf, ExactSpaces);

namespace {

// Directions of samples fit into the bits that the plan counts on, at the largest frame.
TEST(ImageFrame, DirectionsFitTheirBits) {
  for (const std::uint32_t size : {1u, 2u, 3u, 512u, 16384u}) {
    ImageFrame frame;
    frame.right = frame.up = frame.forward = {0x7fff, -0x7fff, 0x7fff};
    frame.width = frame.height = size;
    for (const std::uint32_t i : {0u, size - 1}) {
      for (const std::uint32_t j : {0u, size - 1}) {
        for (const std::int64_t x : frame.direction({i, j})) {
          EXPECT_LT(std::abs(x), std::int64_t{1} << (frame.direction_bits() - 1)) << size;
        }
      }
    }
  }
}

// (n . d) Q(E) - (m . d) P(E) at the greatest values that each factor has.
TEST(ImagePrecision, HoldsTheLargestBracket) {
  for (const unsigned b : {3u, 10u, 20u, 53u}) {
    for (const unsigned p : {20u, 38u, 47u}) {
      const mpz_class size = (mpz_class(1) << b) - 1, d = (mpz_class(1) << (p - 1)) - 1;
      const mpz_class along = 3 * size * size * d, value = 2 * size * size * size;
      const mpz_class bracket = 2 * along * value;
      EXPECT_LE(mpz_sizeinbase(bracket.get_mpz_t(), 2) + 1, image_side_bits(b, p));
      EXPECT_LE(mpz_sizeinbase(along.get_mpz_t(), 2) + 1, image_coverage_bits(b, p));
      const unsigned e = 12;
      const mpz_class far = (mpz_class(1) << e) - 1;
      const mpz_class q_along = 3 * 2 * size * far * d, q_value = 3 * size * size * far;
      const mpz_class sum = along * q_value + q_along * value;
      EXPECT_LE(mpz_sizeinbase(sum.get_mpz_t(), 2) + 1, image_side_bits(b, e, p));
      EXPECT_LE(mpz_sizeinbase(q_along.get_mpz_t(), 2) + 1, image_coverage_bits(b, e, p));
    }
  }
}

}  // namespace
}  // namespace gnomon::test
