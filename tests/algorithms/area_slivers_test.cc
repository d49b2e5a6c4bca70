// SPDX-License-Identifier: GPL-3.0-or-later
// Classes by contour under area lights where a sliver that no double measures decides: behind the
// light's plane, beside a caster that is nearly in the receiver's plane, and between two casters.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "area_check.h"
#include "exact_check.h"
#include "fuzz/generate/scene_pen.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using fuzz::ScenePen;
using fuzz::Triple;
using Point = std::array<double, 3>;

Scene scene_of(const std::vector<std::vector<Point>>& loops, const std::vector<Point>& light) {
  Scene scene;
  const auto put = [](const Point& p) -> std::array<Number, 3> {
    return {Number(p[0]), Number(p[1]), Number(p[2])};
  };
  for (const std::vector<Point>& loop : loops) {
    Polygon& polygon = scene.polygons.emplace_back();
    polygon.id = std::to_string(scene.polygons.size());
    for (const Point& p : loop) {
      polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
      scene.vertices.push_back(put(p));
    }
  }
  Light& panel = scene.lights.emplace_back();
  panel.id = "panel";
  panel.type = LightType::kArea;
  for (const Point& p : light) panel.loop.push_back(put(p));
  return scene;
}

/// A corner of the first polygon is 2^-54 behind the light, and the second one's umbra has no edge
/// on it.
TEST(AreaSlivers, BehindTheLightBesideAnUmbraWithoutEdges) {
  const auto low = Case::make(scene_of(
      {{{-4.875, -6.515625, 1.296875}, {-4.125, -8.140625, 2.21875}, {1.203125, -7.09375, -0.375}},
       {{-3.109375, -6.171875, 0.4375},
        {-5.375, -1.34375, -2.3125},
        {-3.765625, 2.0625, 2.359375},
        {-1.5, -2.765625, 5.109375}}},
      {{26.065758554735268, 61.078061680172, -0.37499999999999994},
       {-2.700593356680187, 61.078061680172, -0.37499999999999994},
       {-2.700593356680187, 8.789108693824168, -0.37499999999999994},
       {26.065758554735268, 8.789108693824168, -0.37499999999999994}}));
  ASSERT_TRUE(low);
  EXPECT_EQ(check_area_exact(*low), "");
}

TEST(AreaSlivers, OfACornerBehindATurnedLight) {
  Scene scene = scene_of({{{-1.9999936000017733, 5.99999680000092, 0.007999995666667484},
                           {2.004004397731707, 5.995997201067387, 4.003995996334668},
                           {2.000004399998373, 5.9999972000007205, 0.003999996333334117}},
                          {{-2.0009935994351067, 6.000996799734254, -0.9919990043336658},
                           {2.9980021011323097, 4.001998299467063, -1.9989980021673328},
                           {5.722163086115073, 5.3164654562511, 2.9597548329321466}}},
                         {{6.0040059977307205, 9.995995601067733, 4.003995994334669},
                          {5.996013202261787, 18.003991598935492, -3.9879960110013304},
                          {14.004009197728747, 17.995992401068428, 4.00399599033467}});
  scene.polygons[1].two_sided = true;
  const auto turned = Case::make(std::move(scene));
  ASSERT_TRUE(turned);
  EXPECT_EQ(check_area_exact(*turned), "");
}

/// On a lattice each coordinate of which may be off by one unit of 2^-46.
TEST(AreaSlivers, OfALatticeThatIsNotQuiteOne) {
  std::uint64_t open = 0, sides = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const auto at = [&](std::int64_t low, std::int64_t high) {
      const std::int64_t place = random.between(low, high) * (std::int64_t{1} << 46);
      return random.between(0, 2) == 0 ? place + random.between(-1, 1) : place;
    };
    ScenePen pen(-46);
    pen.two_sided(seed % 3 == 0);
    for (int i = 0; i < 6; ++i) {
      std::vector<Triple> loop;
      for (int k = 0; k < 3; ++k) loop.push_back({at(0, 3), at(0, 3), at(0, 3)});
      pen.polygon(loop);
    }
    pen.panel({{at(0, 4), at(0, 4), at(2, 5)},
               {at(0, 4), at(0, 4), at(2, 5)},
               {at(0, 4), at(0, 4), at(2, 5)}});
    const auto own = Case::make(pen.take());
    if (!own) continue;  // a light on a line
    ASSERT_EQ(check_area_contour(*own), "") << "seed " << seed << '\n' << text_of(own->scene());
    ShadowOptions options = options_for(KernelId::kPlane);
    options.method.area = MethodId::kContour;
    options.output.exact_fractions = options.output.exact_points = options.output.points = false;
    const auto result = compute_shadows(own->prepared(), options);
    ASSERT_TRUE(result);
    open += result->lights[0].work[Counter::kOpenPolygons];
    sides += result->lights[0].facing_parts;
  }
  EXPECT_GT(sides, 1000u);
  EXPECT_LT(open * 2, sides);
}

/// Of a cut edge one end is so near to the cutting plane that its value underflows, and the other
/// is far from it: the areas are small, and certain none the less.
TEST(AreaSlivers, OfAnEdgeThatBeginsAtThePlaneThatCutsIt) {
  const double small = 3.7654997892232564e-183, large = 2.4242905543444787e127;
  const auto tall = Case::make(scene_of(
      {{{3, 0, 0}, {1, 1, small}, {0, large, 0}}, {{1, 1, small}, {1, 0, 0}, {0, large, 0}}},
      {{0, 0, 0}, {1, 0, 1}, {0, -1, 0}}));
  ASSERT_TRUE(tall);
  EXPECT_EQ(check_area_exact(*tall), "");
  const auto low =
      Case::make(scene_of({{{-1, 0, 0}, {0, 1, 1}, {-1, 1, 0}},
                           {{0x1p-46, 0, 1}, {-1, 0, 1}, {-1, 1, 0}},
                           {{-1, 0, 2.781342323134e-309}, {-1, 1, 0}, {0x1p-46, 0, 1}}},
                          {{0, 1, 0}, {-4, 0, 0}, {0, 0, 0}}));
  ASSERT_TRUE(low);
  EXPECT_EQ(check_area_exact(*low), "");
}

/// Values of lines at corners are integers of so many bits that no double holds them.
TEST(AreaSlivers, OfLinesWithValuesBeyondDoubles) {
  const double high = 1.5426605224886307e62, far = 2.6194299758464335e56;
  const auto scene = Case::make(
      scene_of({{{0, 0, high}, {0, far, -1}, {0, 0, 1}}, {{0, 0, high}, {-1, 1, -1}, {0, 0, 1}}},
               {{5.0407588622375254e-73, 0, 0},
                {-7.260930269727716e66, 0, 0},
                {0, 19898029053629694000.0, 0}}));
  ASSERT_TRUE(scene);
  EXPECT_EQ(check_area_contour(*scene), "");
}

}  // namespace
}  // namespace gnomon::test
