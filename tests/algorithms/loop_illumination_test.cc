// SPDX-License-Identifier: GPL-3.0-or-later
// The contour integral in plain doubles against what is known in closed form.
#include "gnomon/algorithms/loop_illumination.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace gnomon {
namespace {

using Vector = std::array<double, 3>;

/// A square of half-width w at height h, seen from its front, which looks down.
std::vector<Vector> ceiling(double w, double h) {
  return {{-w, -w, h}, {-w, w, h}, {w, w, h}, {w, -w, h}};
}

/// pi times the form factor from below the middle of that square to it: four times that of a
/// rectangle above one of its corners.
double from_below(double w, double h) {
  const double x = w / h;
  const double root = std::sqrt(1 + x * x);
  return 4 * (x / root) * std::atan(x / root);
}

TEST(LoopIllumination, BelowASquare) {
  for (const double w : {0.01, 0.5, 1.0, 3.0, 1000.0}) {
    EXPECT_NEAR(loop_illumination(ceiling(w, 2), {0, 0, 0}, {0, 0, 1}) / from_below(w, 2), 1, 1e-12)
        << w;
  }
}

TEST(LoopIllumination, OfAWholeSkyIsPi) {
  EXPECT_NEAR(loop_illumination(ceiling(1e9, 1), {0, 0, 0}, {0, 0, 1}), std::numbers::pi, 1e-8);
}

TEST(LoopIllumination, OfAFarLightIsItsAreaByTheSquareOfItsDistance) {
  EXPECT_NEAR(loop_illumination(ceiling(1, 1e6), {0, 0, 0}, {0, 0, 1}) * 1e12 / 4, 1, 1e-10);
}

TEST(LoopIllumination, IsTheSumOfItsPieces) {
  const Vector point{0.3, -0.2, 0.1}, normal{0.6, 0, 0.8};
  const std::vector<Vector> whole = ceiling(1, 3);
  const std::vector<Vector> left{whole[0], whole[1], {0.25, 1, 3}, {0.25, -1, 3}},
      right{{0.25, -1, 3}, {0.25, 1, 3}, whole[2], whole[3]};
  EXPECT_NEAR(loop_illumination(whole, point, normal),
              loop_illumination(left, point, normal) + loop_illumination(right, point, normal),
              1e-15);
}

TEST(LoopIllumination, LoopsWithoutAreaGiveNothing) {
  EXPECT_EQ(loop_illumination({}, {0, 0, 0}, {0, 0, 1}), 0);
  const std::vector<Vector> line{{0, 0, 1}, {1, 0, 1}, {2, 0, 1}};
  EXPECT_NEAR(loop_illumination(line, {0, 0, 0}, {0, 0, 1}), 0, 1e-16);
}

}  // namespace
}  // namespace gnomon
