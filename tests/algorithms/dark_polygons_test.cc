// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons that are proven dark before they are met (dark_polygons.h): what covers a polygon and
// what leaves a gap, by hand; and how many of a city's are found.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::test {
namespace {

using fuzz::ScenePen;
using fuzz::Triple;

/// [x0, x1] x [y0, y1] at height z, facing up.
std::vector<Triple> tile(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1,
                         std::int64_t z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

enum class Dark { kNot, kFound, kNotFound };

/// Tiles over [1, 7]^2 at height 0 under an overhead sun, and under a lamp far above.
void expect(const std::vector<std::vector<Triple>>& tiles, Dark dark, const std::string& what) {
  for (const bool lamp : {false, true}) {
    ScenePen pen;
    pen.polygon(tile(1, 1, 7, 7, 0));
    for (const std::vector<Triple>& loop : tiles) pen.polygon(loop);
    if (lamp) {
      pen.lamp({4, 4, 4000});
    } else {
      pen.sun({0, 0, 1});
    }
    const Expected<PreparedScene> scene = prepare(pen.take());
    ASSERT_TRUE(scene) << what;
    ShadowOptions options;
    options.method.point = MethodId::kContour;
    const auto result = compute_shadows(*scene, options);
    ASSERT_TRUE(result) << what;
    const LightResult& light = result->lights.front();
    EXPECT_EQ(light.work[Counter::kDarkPolygons], dark == Dark::kFound ? 1u : 0u)
        << what << (lamp ? ", lamp" : "");
    EXPECT_EQ(light.parts.front().lit.upper == 0, dark != Dark::kNot)
        << what << (lamp ? ", lamp" : "");
  }
}

TEST(DarkPolygons, WhatCovers) {
  expect({tile(0, 0, 8, 8, 1)}, Dark::kFound, "one");
  expect({tile(0, 0, 3, 8, 1), tile(3, 0, 8, 8, 1)}, Dark::kFound, "two that share an edge");
  expect({tile(0, 0, 3, 8, 1), tile(3, 0, 8, 4, 1), tile(3, 4, 8, 8, 1)}, Dark::kFound,
         "a T-junction");
  expect({tile(0, 0, 5, 8, 1), tile(2, 0, 8, 8, 2)}, Dark::kFound, "two that overlap");
  // Around a hole, which a fifth closes from below or above.
  const std::vector<std::vector<Triple>> wheel = {tile(0, 0, 5, 3, 2), tile(5, 0, 8, 5, 2),
                                                  tile(3, 5, 8, 8, 2), tile(0, 3, 3, 8, 2)};
  expect(wheel, Dark::kNot, "a wheel");
  for (const std::int64_t z : {1, 3}) {
    auto closed = wheel;
    closed.push_back(tile(2, 2, 6, 6, z));
    // Two edges that end on one line, but are not one edge, may have a gap for all that the doubles
    // say; exact subtraction finds it dark.
    expect(closed, Dark::kNotFound, "a closed wheel");
  }
  expect({tile(0, 0, 4, 8, 1), tile(5, 0, 8, 8, 1)}, Dark::kNot, "a gap");
  expect({tile(0, 0, 8, 4, 1)}, Dark::kNot, "half");
  expect({tile(0, 0, 3, 3, 1), tile(5, 5, 8, 8, 1)}, Dark::kNot, "two corners");
}

/// A roof that rests on two edges of what it hides, and one that passes through it.
TEST(DarkPolygons, WhatTouches) {
  expect({{{1, 1, 0}, {7, 1, 0}, {7, 7, 6}, {1, 7, 6}}}, Dark::kFound, "a ramp on an edge");
  expect({{{0, 0, -4}, {8, 0, -4}, {8, 8, 4}, {0, 8, 4}}}, Dark::kNot, "one that passes through");
}

TEST(DarkPolygons, AGapOfOneUlp) {
  constexpr std::int64_t one = std::int64_t{1} << 50;
  for (const std::int64_t gap : {0, 1}) {
    ScenePen pen(-50);
    pen.polygon(tile(0, 0, 8 * one, 8 * one, 0));
    pen.polygon(tile(-one, -one, 3 * one, 9 * one, one));
    pen.polygon(tile(3 * one + gap, -one, 9 * one, 9 * one, one)).sun({0, 0, 1});
    const Expected<PreparedScene> scene = prepare(pen.take());
    ASSERT_TRUE(scene);
    ShadowOptions options;
    options.method.point = MethodId::kContour;
    const auto result = compute_shadows(*scene, options);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->lights[0].work[Counter::kDarkPolygons], gap == 0 ? 1u : 0u);
    EXPECT_EQ(result->lights[0].parts[0].lit.upper > 0, gap == 1);
  }
}

TEST(DarkPolygons, OfACity) {
  const Expected<Scene> made = generate("city", {{"n", 400}}, 3);
  ASSERT_TRUE(made);
  const Expected<PreparedScene> scene = prepare(*made);
  ASSERT_TRUE(scene);
  ShadowOptions options;
  options.method.point = MethodId::kContour;
  const auto found = compute_shadows(*scene, options);
  options.method.point = MethodId::kSectors;
  const auto asked = compute_shadows(*scene, options);
  ASSERT_TRUE(found && asked);
  std::uint64_t dark = 0;
  for (const PartResult& part : asked->lights[0].parts) {
    dark += part.reason == ShadowReason::kNone && part.lit.upper == 0;
  }
  EXPECT_GT(dark, 100u);
  EXPECT_LE(found->lights[0].work[Counter::kDarkPolygons], dark);
  EXPECT_GE(found->lights[0].work[Counter::kDarkPolygons], dark * 9 / 10);
}

}  // namespace
}  // namespace gnomon::test
