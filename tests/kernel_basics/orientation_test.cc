// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/kernel/orientation.h"

#include <gtest/gtest.h>

#include <limits>

#include "gnomon/kernel/sign.h"

namespace gnomon {
namespace {

TEST(SignValues, MultiplyLikeSigns) {
  EXPECT_EQ(Sign::kNegative * Sign::kNegative, Sign::kPositive);
  EXPECT_EQ(Sign::kNegative * Sign::kPositive, Sign::kNegative);
  EXPECT_EQ(Sign::kZero * Sign::kNegative, Sign::kZero);
  EXPECT_EQ(-Sign::kPositive, Sign::kNegative);
  EXPECT_EQ(opposite(Side::kFront), Side::kBack);
  EXPECT_EQ(opposite(Side::kOn), Side::kOn);
  EXPECT_EQ(side_of(Sign::kPositive), Side::kFront);
}

TEST(SignValues, NothingCanBeSaidOfNotANumber) {
  EXPECT_EQ(sign_of(std::numeric_limits<double>::quiet_NaN()), Sign::kZero);
  EXPECT_EQ(sign_of(-0.0), Sign::kZero);
  EXPECT_EQ(sign_of(std::numeric_limits<double>::denorm_min()), Sign::kPositive);
}

TEST(PlaneRefs, CarryIndexAndOrientation) {
  const PlaneRef plane(7);
  EXPECT_TRUE(plane.valid());
  EXPECT_FALSE(plane.flipped());
  EXPECT_TRUE((-plane).flipped());
  EXPECT_EQ((-plane).index(), 7u);
  EXPECT_EQ(-(-plane), plane);
  EXPECT_NE(-plane, plane);
  EXPECT_TRUE(plane.same_plane(-plane));
  EXPECT_FALSE(plane.same_plane(PlaneRef(6)));
  EXPECT_EQ(PlaneRef(7, true), -plane);
}

TEST(PlaneRefs, PlaneZeroHasAnOpposite) {
  EXPECT_NE(PlaneRef(0), -PlaneRef(0));
  EXPECT_EQ((-PlaneRef(0)).index(), 0u);
  EXPECT_FALSE(PlaneRef().valid());
}

}  // namespace
}  // namespace gnomon
