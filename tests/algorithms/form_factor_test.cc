// SPDX-License-Identifier: GPL-3.0-or-later
// Form factors: the closed forms of parallel and perpendicular rectangles to a dozen digits, boxes
// and plates whose factors follow from them with something in between, and what points see of an
// area light (an engine of its own) where no closed form is.
#include "gnomon/algorithms/form_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "algorithms/form_factors/line_integral.h"
#include "gnomon/algorithms/illumination.h"
#include "light_soup.h"

namespace gnomon::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Two equal rectangles a x b, opposite each other at distance c.
double parallel(double a, double b, double c) {
  const double x = a / c, y = b / c;
  const double s = std::sqrt(1 + x * x), t = std::sqrt(1 + y * y);
  return 2 / (kPi * x * y) *
         (0.5 * std::log(s * s * t * t / (1 + x * x + y * y)) + x * t * std::atan(x / t) +
          y * s * std::atan(y / s) - x * std::atan(x) - y * std::atan(y));
}

/// From a rectangle of width w to one of height h, at right angles along a common edge of length l.
double perpendicular(double l, double w_size, double h_size) {
  const double w = w_size / l, h = h_size / l, ww = w * w, hh = h * h, r = ww + hh;
  return 1 / (kPi * w) *
         (w * std::atan(1 / w) + h * std::atan(1 / h) - std::sqrt(r) * std::atan(1 / std::sqrt(r)) +
          0.25 *
              std::log((1 + ww) * (1 + hh) / (1 + r) * std::pow(ww * (1 + r) / ((1 + ww) * r), ww) *
                       std::pow(hh * (1 + r) / ((1 + hh) * r), hh)));
}

std::vector<Triple> level(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}
std::vector<Triple> reversed(std::vector<Triple> loop) { return {loop.rbegin(), loop.rend()}; }

FormFactor factor(const PreparedScene& scene, std::uint32_t from, std::uint32_t to,
                  const FormFactorOptions& options = {}) {
  const auto found = view_factor(scene, from, Side::kFront, to, options);
  if (!found) throw std::runtime_error(to_string(found.error()));
  EXPECT_LE(found->lower, found->value);
  EXPECT_LE(found->value, found->upper);
  return *found;
}
FormFactor sky(const PreparedScene& scene, std::uint32_t polygon, Side side = Side::kFront,
               const FormFactorOptions& options = {}) {
  const auto found = sky_factor(scene, polygon, side, options);
  if (!found) throw std::runtime_error(to_string(found.error()));
  EXPECT_LE(found->lower, found->value);
  EXPECT_LE(found->value, found->upper);
  return *found;
}

void expect_closed_form(const FormFactor& found, double truth) {
  EXPECT_NEAR(found.value, truth, 1e-11);
  EXPECT_LE(found.lower, truth + 1e-13);
  EXPECT_GE(found.upper, truth - 1e-13);
  EXPECT_LE(found.upper - found.lower, 1e-9);
}

TEST(FormFactor, ParallelRectangles) {
  for (const auto& [a, b, c] : {std::array{1.0, 1.0, 1.0}, std::array{2.0, 0.5, 0.25},
                                std::array{1.0, 3.0, 10.0}, std::array{1.0, 1.0, 0.001}}) {
    LightSceneBuilder builder;
    builder.polygon(level(0, 0, a, b, 0));
    builder.polygon(reversed(level(0, 0, a, b, c)));
    SCOPED_TRACE(c);
    expect_closed_form(factor(builder.build(), 0, 1), parallel(a, b, c));
  }
}

TEST(FormFactor, PerpendicularRectangles) {
  for (const auto& [l, w, h] :
       {std::array{1.0, 1.0, 1.0}, std::array{2.0, 0.5, 3.0}, std::array{1.0, 4.0, 0.125}}) {
    LightSceneBuilder builder;
    builder.polygon(level(0, 0, l, w, 0));
    builder.polygon({{0, 0, 0}, {0, 0, h}, {l, 0, h}, {l, 0, 0}});  // looks to +y
    SCOPED_TRACE(w);
    expect_closed_form(factor(builder.build(), 0, 1), perpendicular(l, w, h));
    expect_closed_form(factor(builder.build(), 1, 0), perpendicular(l, h, w));
  }
}

TEST(FormFactor, ReciprocityFarFromTheOrigin) {
  const double far = 1 << 30;
  LightSceneBuilder builder;
  builder.polygon(level(far, far, far + 1, far + 2, 0));
  builder.polygon(reversed(level(far + 3, far + 1, far + 8, far + 4, 2)));
  const PreparedScene scene = builder.build();
  const FormFactor there = factor(scene, 0, 1), back = factor(scene, 1, 0);
  EXPECT_GT(there.value, 0.01);
  EXPECT_NEAR(2 * there.value, 15 * back.value, 1e-10);
}

TEST(FormFactor, FacesThatLookAwayExchangeNothing) {
  LightSceneBuilder builder;
  builder.polygon(level(0, 0, 1, 1, 0));
  builder.polygon(level(0, 0, 1, 1, 1));        // looks up, away
  builder.polygon(level(0, 0, 1, 1, 2), true);  // both ways
  const PreparedScene scene = builder.build();
  EXPECT_EQ(factor(scene, 0, 1).upper, 0);
  EXPECT_EQ(factor(scene, 0, 0).upper, 0);
  // What looks away stops nothing that comes from above, as one side casts.
  EXPECT_EQ(view_factor(scene, 2, Side::kFront, 1, {})->upper, 0);
  EXPECT_NEAR(view_factor(scene, 2, Side::kBack, 1, {})->value, parallel(1, 1, 1), 1e-11);
}

TEST(FormFactor, PlateBetween) {
  // A plate halfway that covers everything; one that leaves a gap along one side, as wide as it is.
  const auto scene_with = [](const std::vector<Triple>& plate) {
    LightSceneBuilder builder;
    builder.polygon(level(0, 0, 1, 1, 0));
    builder.polygon(reversed(level(0, 0, 1, 1, 1)));
    builder.polygon(plate, true);
    return builder.build();
  };
  const FormFactor none = factor(scene_with(level(-9, -9, 9, 9, 0.5)), 0, 1);
  EXPECT_EQ(none.upper, 0);
  EXPECT_NEAR(none.unobstructed, parallel(1, 1, 1), 1e-11);
  // A wall on the middle line between floor and ceiling: half of what crosses the middle is lost,
  // so what is left is what each half exchanges with the half above it.
  FormFactorOptions options;
  options.tolerance = 2e-2;
  options.most_cells = 20000;
  const FormFactor wall =
      factor(scene_with({{0.5, -9, -1}, {0.5, 9, -1}, {0.5, 9, 2}, {0.5, -9, 2}}), 0, 1, options);
  const double half = parallel(0.5, 1, 1);
  EXPECT_LE(wall.lower, half);
  EXPECT_GE(wall.upper, half);
  EXPECT_LE(wall.upper - wall.lower, 2e-2 + 1e-9);
  EXPECT_NEAR(wall.value, half, 1e-3);
}

/// A box of walls that look inwards, open at the top.
PreparedScene open_box(double a, double b, double c) {
  LightSceneBuilder builder;
  builder.polygon(level(0, 0, a, b, 0));
  builder.polygon({{0, 0, 0}, {0, 0, c}, {a, 0, c}, {a, 0, 0}}, true);
  builder.polygon({{a, b, 0}, {a, b, c}, {0, b, c}, {0, b, 0}}, true);
  builder.polygon({{0, b, 0}, {0, b, c}, {0, 0, c}, {0, 0, 0}}, true);
  builder.polygon({{a, 0, 0}, {a, 0, c}, {a, b, c}, {a, b, 0}}, true);
  return builder.build();
}

TEST(SkyFactor, OpenBox) {
  const double a = 2, b = 1, c = 0.75;
  const PreparedScene box = open_box(a, b, c);
  FormFactorOptions options;
  options.tolerance = 5e-2;
  options.most_cells = 20000;
  const FormFactor floor = sky(box, 0, Side::kFront, options);
  const double truth = parallel(a, b, c);
  EXPECT_LE(floor.lower, truth);
  EXPECT_GE(floor.upper, truth);
  EXPECT_TRUE(floor.within_tolerance) << floor.upper - floor.lower;
  EXPECT_NEAR(floor.value, truth, 2e-3);
  // A wall sees the sky through the opening alone.
  const FormFactor wall = sky(box, 1, Side::kFront, options);
  const double opening = perpendicular(a, c, b);
  EXPECT_LE(wall.lower, opening);
  EXPECT_GE(wall.upper, opening);
  EXPECT_NEAR(wall.value, opening, 2e-3);
  // And from outside half of it.
  const FormFactor outside = sky(box, 1, Side::kBack, options);
  EXPECT_NEAR(outside.value, 0.5, 1e-12);
  EXPECT_LE(outside.upper - outside.lower, 1e-9);
}

TEST(SkyFactor, Unobstructed) {
  LightSceneBuilder builder;
  builder.polygon(level(0, 0, 1, 1, 0), true);
  builder.polygon({{5, 0, 0}, {5, 0, 3}, {5, 4, 0}});    // a wall
  builder.polygon({{9, 0, 0}, {10, 0, 1}, {10, 1, 1}});  // 45 degrees
  const PreparedScene scene = builder.build();
  FormFactorOptions options;
  EXPECT_NEAR(sky(scene, 0).unobstructed, 1, 1e-12);
  EXPECT_EQ(sky(scene, 0, Side::kBack).value, 0);
  EXPECT_NEAR(sky(scene, 1).unobstructed, 0.5, 1e-12);
  EXPECT_NEAR(sky(scene, 2).unobstructed, (1 + std::sqrt(0.5)) / 2, 1e-12);
  options.up = {0, 0, -3};
  EXPECT_NEAR(sky(scene, 0, Side::kBack, options).unobstructed, 1, 1e-12);
  options.up = {0, 0, 0};
  EXPECT_FALSE(sky_factor(scene, 0, Side::kFront, options));
}

TEST(SkyFactor, BoundsHoldOfLooseAndTightTolerances) {
  // A canopy over half of the ground, two-sided, that touches a wall.
  LightSceneBuilder builder;
  builder.polygon(level(0, 0, 4, 4, 0));
  builder.polygon(level(0, 0, 2, 4, 2), true);
  builder.polygon({{0, 0, 0}, {0, 4, 0}, {0, 4, 2}, {0, 0, 2}}, true);
  const PreparedScene scene = builder.build();
  double lower = 0, upper = 1, value = 0;
  for (const double tolerance : {0.5, 0.1, 0.03}) {
    FormFactorOptions options;
    options.tolerance = tolerance;
    options.most_cells = 20000;
    const FormFactor found = sky(scene, 0, Side::kFront, options);
    EXPECT_TRUE(found.within_tolerance) << tolerance << " " << found.upper - found.lower;
    EXPECT_GE(found.upper + 1e-12, lower);
    EXPECT_LE(found.lower, upper + 1e-12);
    lower = std::max(lower, found.lower);
    upper = std::min(upper, found.upper);
    value = found.value;
  }
  EXPECT_LE(lower, value);
  EXPECT_LE(value, upper);
}

/// The view factor by midpoints of a grid, what each sees of the target by another engine: the
/// target is the scene's area light.
double by_illumination(const PreparedScene& scene, std::uint32_t part, const Triple& origin,
                       const Triple& u, const Triple& v, int steps) {
  const Illuminator illuminator(scene, 0, 1.0);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      ExactPoint3 point;
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] = mpq_class(origin[k]) + mpq_class(u[k]) * mpq_class(2 * i + 1, 2 * steps) +
                   mpq_class(v[k]) * mpq_class(2 * j + 1, 2 * steps);
      }
      sum += illuminator.at(part, Side::kFront, point, false, nullptr).value;
    }
  }
  return sum / (steps * steps) / kPi;
}

TEST(FormFactor, AgainstIllumination) {
  // Several casters between: some overlap, one crosses the receiver's plane, one touches it.
  const auto fill = [](LightSceneBuilder& builder) {
    builder.polygon(level(0, 0, 4, 3, 0));
    builder.polygon({{1, 1, 1}, {2.5, 1, 1.25}, {2.5, 2, 1.25}, {1, 2, 1}}, true);
    builder.polygon({{1.5, 0.5, 2}, {3.5, 0.5, 2}, {3, 2.5, 1.5}}, true);
    builder.polygon({{3, -1, -1}, {3, 1.5, -1}, {3, 1.5, 1}, {3, -1, 1}}, true);
    builder.polygon({{0.5, 2, 0}, {1.5, 2.5, 0}, {1, 2.25, 2}}, true);
  };
  const std::vector<Triple> target = reversed(level(-1, -1, 3, 2, 3));
  LightSceneBuilder with_light, with_polygon;
  fill(with_light);
  with_light.area(target);
  fill(with_polygon);
  with_polygon.polygon(target);
  const PreparedScene scene = with_polygon.build();
  FormFactorOptions options;
  options.tolerance = 4e-2;
  options.most_cells = 20000;
  const FormFactor found = factor(scene, 0, 5, options);
  const double truth = by_illumination(with_light.build(), 0, {0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 40);
  EXPECT_TRUE(found.within_tolerance) << found.upper - found.lower;
  EXPECT_LE(found.lower, truth + 1e-3);
  EXPECT_GE(found.upper, truth - 1e-3);
  EXPECT_NEAR(found.value, truth, 2e-3);
  EXPECT_GT(found.unobstructed, found.value + 0.02);
}

}  // namespace
}  // namespace gnomon::test
