// SPDX-License-Identifier: GPL-3.0-or-later
// Regions of lights: on scenes of all families, with planes through their own vertices, through
// the light, in the planes of polygons and anywhere, all methods on all exact kernels equal the
// oracle; parts that can do nothing inside are left out; and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "gnomon/scene/light_arguments.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

/// A point whose coordinates are those of vertices: often a vertex, or the light.
Position point_of(const Scene& scene, const Light& light, Random& random) {
  const auto vertex = [&]() -> const Position& {
    return scene.vertices[random.below(scene.vertices.size())];
  };
  const std::uint64_t kind = random.below(4);
  if (kind == 0 && light.is_point()) return light.position;
  if (kind < 3) return vertex();
  return {vertex()[0], vertex()[1], vertex()[2]};
}

Scene with_regions(Scene scene, std::uint64_t seed) {
  Random random(seed);
  for (Light& light : scene.lights) {
    if (light.has_area() || scene.vertices.empty()) continue;
    const std::uint64_t planes = random.below(4);
    for (std::uint64_t i = 0; i < planes; ++i) {
      light.region.push_back({point_of(scene, light, random), point_of(scene, light, random),
                              point_of(scene, light, random)});
    }
  }
  return scene;
}

class Regions : public testing::TestWithParam<fuzz::Family> {};

TEST_P(Regions, MethodsKernelsAndOracleAgree) {
  if (GetParam().name == "MixedMagnitudes") GTEST_SKIP() << "thousands of digits";
  constexpr unsigned kScenes = 6, kTries = 60;
  unsigned checked = 0;
  for (std::uint64_t seed = 71000; seed < 71000 + kTries && checked < kScenes; ++seed) {
    const auto scene = Case::make(with_regions(GetParam().make(seed), seed));
    if (!scene) continue;  // three points on a line, too
    if (std::ranges::all_of(scene->prepared().lights,
                            [](const PreparedLight& light) { return light.region.empty(); })) {
      continue;
    }
    ++checked;
    ASSERT_EQ(check_methods(*scene), "") << "seed " << seed << "\n" << text_of(scene->scene());
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Regions, testing::ValuesIn(fuzz::families()),
                         [](const auto& info) { return info.param.name; });

/// A floor [0,4]^2 at z = 0 and a square [1,2]^2 at z = 1 under a lamp above.
Scene table() {
  Scene scene;
  scene.name = "table";
  const auto add = [&](const char* id, double low, double high, double z) {
    Polygon& polygon = scene.polygons.emplace_back();
    polygon.id = id;
    for (const auto& [x, y] :
         {std::pair(low, low), std::pair(high, low), std::pair(high, high), std::pair(low, high)}) {
      polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
      scene.vertices.push_back({Number(x), Number(y), Number(z)});
    }
  };
  add("floor", 0, 4, 0);
  add("quad", 1, 2, 1);
  Light& lamp = scene.lights.emplace_back();
  lamp.id = "lamp";
  lamp.position = {Number(2.0), Number(2.0), Number(4.0)};
  return scene;
}

mpq_class lit(const Scene& scene, const char* polygon, MethodId method = MethodId::kSectors) {
  const auto prepared = Case::make(scene);
  ShadowOptions options = options_for(KernelId::kPlane);
  options.method.point = method;
  return lit_fraction_of(*prepared, options, "lamp", polygon);
}

TEST(Region, FlapsKeepALayer) {
  Scene scene = table();
  // The quad is outside, and its shadow not: x from 2/3 to 2 on the floor, and y alike.
  ASSERT_TRUE(add_regions(scene, {{}, {"z:0:0.5"}}));
  EXPECT_EQ(lit(scene, "floor"), mpq_class(1) - mpq_class(16, 9) / 16);
  EXPECT_EQ(lit(scene, "quad"), 0);
  // A floor that lies in a plane of the region is inside of it.
  scene = table();
  ASSERT_TRUE(add_regions(scene, {{}, {"z::0"}}));
  EXPECT_EQ(lit(scene, "floor"), mpq_class(1) - mpq_class(16, 9) / 16);
}

TEST(Region, ConesArePyramids) {
  Scene scene = table();
  // Half of the floor; what of the shadow is there, x from 2/3 to 2, is all of it.
  ASSERT_TRUE(add_regions(scene, {{"0,0,0:2,0,0:2,4,0:0,4,0"}, {}}));
  for (const MethodId method :
       {MethodId::kSectors, MethodId::kSvbsp, MethodId::kReceiver, MethodId::kTiling}) {
    EXPECT_EQ(lit(scene, "floor", method), mpq_class(1, 2) - mpq_class(16, 9) / 16);
    EXPECT_EQ(lit(scene, "quad", method), 1);
  }
}

TEST(Region, OfAFarLamp) {
  // So far away that the grid would start at the vertices, if it could.
  Scene scene = table();
  scene.lights[0].position[2] = Number(0x1p60);
  ASSERT_TRUE(add_regions(scene, {{}, {"x:3:"}}));
  for (const MethodId method :
       {MethodId::kSectors, MethodId::kSvbsp, MethodId::kReceiver, MethodId::kTiling}) {
    EXPECT_EQ(lit(scene, "floor", method), mpq_class(1, 4));
  }
}

TEST(Region, PartsThatCanDoNothingAreLeftOut) {
  Scene scene = table();
  ASSERT_TRUE(add_regions(scene, {{}, {"z:0.5:"}}));  // the floor is outside, and casts below
  const auto own = Case::make(scene);
  for (const MethodId method : {MethodId::kSectors, MethodId::kSvbsp}) {
    ShadowOptions options = options_for(KernelId::kPlane);
    options.method.point = method;
    const auto result = compute_shadows(own->prepared(), options);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->lights[0].facing_parts, 1u);
    const PartResult& floor = result->lights[0].parts[0];
    EXPECT_EQ(floor.reason, ShadowReason::kNone);
    ASSERT_EQ(floor.fragment_count, 1u);
    EXPECT_EQ(result->lights[0].fragments[floor.first_fragment].reason,
              ShadowReason::kOutsideRegion);
  }
}

TEST(Region, WhatIsNoRegionIsRefused) {
  const auto refused = [](const RegionArguments& arguments) {
    Scene scene = table();
    const auto added = add_regions(scene, arguments);
    return added ? std::string() : to_string(added.error());
  };
  EXPECT_THAT(refused({{}, {"z"}}), HasSubstr("no slab"));
  EXPECT_THAT(refused({{}, {"w:0:1"}}), HasSubstr("no slab"));
  EXPECT_THAT(refused({{}, {"z::"}}), HasSubstr("no slab"));
  EXPECT_THAT(refused({{}, {"z:1:0"}}), HasSubstr("upside down"));
  EXPECT_THAT(refused({{}, {"z:a:0"}}), HasSubstr("--flap"));
  EXPECT_THAT(refused({{"0,0,0:1,0,0"}, {}}), HasSubstr("fewer than three"));
  EXPECT_THAT(refused({{"0,0,0:1,0,0:1,x,0"}, {}}), HasSubstr("--cone"));
  EXPECT_THAT(refused({{"0,0,0:4,4,0:4,0,0:0,4,0"}, {}}), HasSubstr("not convex"));
  EXPECT_THAT(refused({{"2,2,0:2,2,1:2,2,2"}, {}}), HasSubstr("in a plane with it"));
  Scene scene = table();
  scene.lights[0].type = LightType::kDirectional;
  EXPECT_FALSE(add_regions(scene, {{"0,0,0:1,0,0:1,1,0"}, {}}));
  scene = table();
  const Position point = scene.vertices[0];
  scene.lights[0].region.push_back({point, point, scene.vertices[1]});
  std::string why;
  EXPECT_EQ(Case::make(scene, &why), nullptr);
  EXPECT_THAT(why, HasSubstr("/lights/0/region/0"));
  EXPECT_THAT(why, HasSubstr("on one line"));
}

}  // namespace
}  // namespace gnomon::test
