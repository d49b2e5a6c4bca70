// SPDX-License-Identifier: GPL-3.0-or-later
// What points see and receive of area lights: every exact kernel finds the exact share and the
// proven illumination by every method, on the families of area lights; rounded kernels find it
// nearly on a plain room; and what is wrong is counted.
#include "comparison/received_light/received_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/area_families.h"
#include "fuzz/generate/scene_pen.h"
#include "method_variants.h"

namespace gnomon::comparison {
namespace {

using fuzz::Family;
using fuzz::ScenePen;
using test::Case;
using testing::HasSubstr;

std::vector<MethodSelection> sight_methods() {
  std::vector<MethodSelection> methods = test::method_variants();
  std::erase_if(methods, [](const MethodSelection& method) {
    const Method& info = method_info(method.id);
    return !info.lights.point || !info.makes_fragments || method.values.cover == Cover::kOverlay;
  });
  return methods;
}

/// Lights of these are slivers seen at a grazing angle: the nearest doubles of their vertices give
/// another light.
bool is_ill_conditioned(const Family& family) {
  return family.name == "Needles" || family.name == "MixedMagnitudes";
}

class ReceivedLightOf : public testing::TestWithParam<Family> {};

TEST_P(ReceivedLightOf, ExactKernelsFindWhatIsTrue) {
  const std::vector<MethodSelection> methods = sight_methods();
  constexpr std::size_t kEnough = 60;
  constexpr std::array kKernels{KernelId::kPlane, KernelId::kRational, KernelId::kEpeck};
  std::size_t judged = 0, partly = 0;
  for (std::uint64_t seed = 1; seed <= 60 && judged < kEnough; ++seed) {
    const auto scene = Case::make(GetParam().make(seed));
    if (!scene) continue;
    for (std::uint32_t l = 0; l < scene->prepared().lights.size(); ++l) {
      if (!scene->is_area(l)) continue;
      for (std::uint32_t polygon = 0; polygon < scene->scene().polygons.size(); ++polygon) {
        const auto& first = scene->prepared().first_part;
        if (first[polygon] == first[polygon + 1]) continue;
        const auto light = ReceivedLight::make(scene->scene(), scene->prepared(), {l, polygon});
        if (!light) continue;  // a bent polygon
        for (const Position& position : light->spread_points(2, seed)) {
          const auto point = light->at(position);
          ASSERT_TRUE(point) << to_string(point.error());
          const auto seen = light->scene_of(*point);
          ASSERT_TRUE(seen) << to_string(seen.error());
          ShadowOptions options =
              test::with_method(test::options_for(kKernels[judged % kKernels.size()]),
                                methods[judged / kKernels.size() % methods.size()]);
          const auto found = light->found(*point, *seen, options);
          ASSERT_TRUE(found) << to_string(found.error());
          if (found->exact_share) {
            EXPECT_EQ(*found->exact_share, point->visible);
          }
          EXPECT_EQ(found->sight, point->sight);
          if (!is_ill_conditioned(GetParam())) {
            EXPECT_NEAR(found->received, point->received.value,
                        1e-9 * point->unobstructed.value + 1e-300);
          }
          if (HasFailure()) {
            FAIL() << "seed " << seed << ", light " << l << ", polygon " << polygon << ", by "
                   << test::text_of(methods[(judged / kKernels.size()) % methods.size()]) << "\n"
                   << test::text_of(scene->scene());
          }
          ++judged;
          if (point->sight == Sight::kPart) ++partly;
        }
      }
    }
  }
  EXPECT_GE(judged, 12u);
  EXPECT_GE(partly, 1u);
}

INSTANTIATE_TEST_SUITE_P(Families, ReceivedLightOf, testing::ValuesIn(fuzz::area_families()),
                         [](const auto& info) { return info.param.name; });

/// A floor, a shade at half the height of a panel above it.
Scene lit_room() {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  pen.polygon({{1, 1, 2}, {2, 1, 2}, {2, 3, 2}, {1, 3, 2}});
  pen.panel({{0, 0, 4}, {0, 4, 4}, {4, 4, 4}, {4, 0, 4}});
  return pen.take();
}

Position position(double x, double y, double z) { return {Number(x), Number(y), Number(z)}; }

TEST(ReceivedLight, OfAPanelThatIsHalfHidden) {
  const auto scene = Case::make(lit_room());
  ASSERT_TRUE(scene);
  const auto light = ReceivedLight::make(scene->scene(), scene->prepared(), {0, 0});
  ASSERT_TRUE(light);
  const auto point = light->at(position(2, 2, 0));
  ASSERT_TRUE(point) << to_string(point.error());
  EXPECT_EQ(point->sight, Sight::kPart);
  EXPECT_EQ(point->in_front, 1);
  EXPECT_EQ(point->visible, mpq_class(1, 2));
  // The panel's halves look alike from its middle.
  EXPECT_NEAR(point->received.value, point->unobstructed.value / 2, 1e-12);
  const auto seen = light->scene_of(*point);
  ASSERT_TRUE(seen);
  for (const KernelId kernel : {KernelId::kDouble, KernelId::kLongDouble, KernelId::kPlane}) {
    const auto found = light->found(*point, *seen, test::options_for(kernel));
    ASSERT_TRUE(found);
    KernelReceipt receipt;
    add_to(receipt, 0, *point, *found);
    EXPECT_FALSE(receipt.failed(1e-9)) << kernel_info(kernel).name;
    // What sees half of it is no point that sees all of it.
    PointSight other = *point;
    other.sight = Sight::kAll;
    other.visible = 1;
    other.received = other.unobstructed;
    add_to(receipt, 1, other, *found);
    EXPECT_TRUE(receipt.failed(1e-9));
    EXPECT_EQ(receipt.wrong, 1u);
    EXPECT_EQ(receipt.worst, 1u);
    EXPECT_NEAR(receipt.share_off, 0.5, 1e-9);
    EXPECT_NEAR(receipt.received_off, 0.5, 1e-9);
    EXPECT_EQ(receipt.differs, kernel == KernelId::kPlane);
  }
}

TEST(ReceivedLight, PointsOutsideThePlaneAreRefused) {
  const auto scene = Case::make(lit_room());
  ASSERT_TRUE(scene);
  const auto light = ReceivedLight::make(scene->scene(), scene->prepared(), {0, 0});
  ASSERT_TRUE(light);
  const auto point = light->at(position(2, 2, 0.25));
  ASSERT_FALSE(point);
  EXPECT_THAT(to_string(point.error()), HasSubstr("0.25 off the plane of polygon '0'"));
}

TEST(ReceivedLight, SpreadPointsLieInThePolygon) {
  Scene room = lit_room();
  room.vertices[2][2] = Number(0.0);
  const auto scene = Case::make(room);
  ASSERT_TRUE(scene);
  const auto light = ReceivedLight::make(scene->scene(), scene->prepared(), {0, 0});
  ASSERT_TRUE(light);
  const std::vector<Position> points = light->spread_points(100, 7);
  ASSERT_EQ(points.size(), 100u);
  for (const Position& point : points) {
    EXPECT_TRUE(point[2].is_zero());
    for (const Number& c : {point[0], point[1]}) {
      EXPECT_GT(c.exact(), 0);
      EXPECT_LT(c.exact(), 4);
    }
  }
  EXPECT_EQ(points, light->spread_points(100, 7));
  EXPECT_NE(points, light->spread_points(100, 8));
}

}  // namespace
}  // namespace gnomon::comparison
