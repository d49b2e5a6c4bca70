// SPDX-License-Identifier: GPL-3.0-or-later
// The storage changes at 63 bits; what is stored does not.
#include <gtest/gtest.h>

#include <limits>

#include "gnomon/kernel/geometry.h"

namespace gnomon {
namespace {

mpz_class power_of_two(unsigned exponent) {
  mpz_class result = 1;
  result <<= exponent;
  return result;
}

TEST(GridPositions, NoneAtAll) {
  const GridPositions grid = GridPositions::from({});
  EXPECT_EQ(grid.size(), 0u);
  EXPECT_EQ(grid.bits(), 0u);
}

TEST(GridPositions, OnlyTheOrigin) {
  const GridPositions grid = GridPositions::from({0, 0, 0});
  EXPECT_EQ(grid.size(), 1u);
  EXPECT_EQ(grid.bits(), 0u);
  EXPECT_EQ(grid.at(0, 2), 0);
}

TEST(GridPositions, NarrowUpToItsLimit) {
  const mpz_class largest = power_of_two(GridPositions::kNarrowBits) - 1;
  const GridPositions grid = GridPositions::from({1, 2, 3, 0, largest, 5});
  EXPECT_EQ(grid.size(), 2u);
  EXPECT_EQ(grid.bits(), GridPositions::kNarrowBits);
  ASSERT_TRUE(grid.is_narrow());
  EXPECT_EQ(grid.narrow(0, 2), 3);
  EXPECT_EQ(grid.narrow(1, 1), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(grid.at(1, 1), largest);
}

TEST(GridPositions, WideFromOneBitMore) {
  const mpz_class smallest = power_of_two(GridPositions::kNarrowBits);
  const GridPositions grid = GridPositions::from({1, 2, 3, 0, smallest, 5});
  EXPECT_EQ(grid.size(), 2u);
  EXPECT_EQ(grid.bits(), GridPositions::kNarrowBits + 1);
  ASSERT_FALSE(grid.is_narrow());
  EXPECT_EQ(grid.wide(1, 1), smallest);
  EXPECT_EQ(grid.at(0, 0), 1);
}

}  // namespace
}  // namespace gnomon
