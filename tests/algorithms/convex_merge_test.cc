// SPDX-License-Identifier: GPL-3.0-or-later
// Fragments merged across splits: figure 6 of Slater 1992, sets of casters, and that nothing but
// the number of fragments changes. That the classes are the oracle's, and that sets of casters
// hold, method_suite_test.cc says of every scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "gnomon/scene/generate.h"

namespace gnomon::test {
namespace {

struct Rectangle {
  const char* id;
  double x0, y0, x1, y1, z;
};

Scene under_the_sun(std::initializer_list<Rectangle> rectangles) {
  Scene scene;
  for (const auto& [id, x0, y0, x1, y1, z] : rectangles) {
    Polygon& polygon = scene.polygons.emplace_back();
    polygon.id = id;
    for (const auto& [x, y] :
         {std::pair(x0, y0), std::pair(x1, y0), std::pair(x1, y1), std::pair(x0, y1)}) {
      polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
      scene.vertices.push_back({Number(x), Number(y), Number(z)});
    }
  }
  Light& sun = scene.lights.emplace_back();
  sun.id = "sun";
  sun.type = LightType::kDirectional;
  sun.position = {Number(0.0), Number(0.0), Number(1.0)};
  return scene;
}

LightResult by_svbsp(const Case& scene, MergeOf merge) {
  ShadowOptions options = options_for(KernelId::kPlane);
  options.method.point = MethodId::kSvbsp;
  options.method.options.merge = merge;
  options.method.prefix = false;
  auto result = compute_shadows(scene.prepared(), options);
  EXPECT_TRUE(result);
  return std::move(result->lights[0]);
}

std::vector<Fragment> shadows_on(const LightResult& light, std::uint32_t part) {
  std::vector<Fragment> shadows;
  for (std::uint32_t f = 0; f < light.parts[part].fragment_count; ++f) {
    const Fragment& fragment = light.fragments[light.parts[part].first_fragment + f];
    if (fragment.state == LightState::kShadow) shadows.push_back(fragment);
  }
  return shadows;
}

TEST(ConvexMerge, FigureSixOfSlater) {
  // p1 before p2 before p3: p1 cuts p2 in two, and the shadow of the three on p3 is p2's.
  const auto scene = Case::make(generate("slater-figure-6").value());
  EXPECT_EQ(shadows_on(by_svbsp(*scene, MergeOf::kSiblings), 2).size(), 3u);
  const LightResult merged = by_svbsp(*scene, MergeOf::kConvex);
  const std::vector<Fragment> one = shadows_on(merged, 2);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].caster, 1u);
  EXPECT_EQ(one[0].count, 4u);
  EXPECT_GE(merged.work[Counter::kMerged], 2u);
}

TEST(ConvexMerge, FigureTwoOfChinAndFeiner) {
  // ab and cd are inserted unsplit; ef is split at g, and eg is behind ab.
  const auto scene = Case::make(generate("svbsp-figure-2").value());
  const LightResult light = by_svbsp(*scene, MergeOf::kNone);
  EXPECT_EQ(light.parts[0].fragment_count, 1u);
  EXPECT_EQ(light.parts[1].fragment_count, 1u);
  EXPECT_EQ(light.parts[2].fragment_count, 2u);
  const std::vector<Fragment> hidden = shadows_on(light, 2);
  ASSERT_EQ(hidden.size(), 1u);
  EXPECT_EQ(hidden[0].caster, 0u);
  EXPECT_TRUE(shadows_on(light, 0).empty());
  EXPECT_TRUE(shadows_on(light, 1).empty());
}

TEST(ConvexMerge, SeveralCastersTogether) {
  const auto scene = Case::make(
      under_the_sun({{"left", 0, 0, 1, 1, 1}, {"right", 1, 0, 2, 1, 2}, {"p", -1, -1, 3, 3, 0}}));
  const LightResult merged = by_svbsp(*scene, MergeOf::kConvex);
  const std::vector<Fragment> one = shadows_on(merged, 2);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].caster, Fragment::kNoCaster);
  std::vector<std::uint32_t> casters = merged.caster_sets.at(one[0].casters);
  std::ranges::sort(casters);
  EXPECT_EQ(casters, (std::vector<std::uint32_t>{0, 1}));
}

TEST(ConvexMerge, FragmentsAloneChange) {
  std::uint64_t siblings = 0, convex = 0, off = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto scene = Case::make(fuzz::families()[0].make(seed));
    if (!scene) continue;
    const LightResult usual = by_svbsp(*scene, MergeOf::kSiblings);
    const LightResult merged = by_svbsp(*scene, MergeOf::kConvex);
    for (std::size_t i = 0; i < usual.parts.size(); ++i) {
      ASSERT_EQ(usual.exact_fractions[i].lit, merged.exact_fractions[i].lit) << seed;
    }
    siblings += usual.fragment_total;
    convex += merged.fragment_total;
    off += by_svbsp(*scene, MergeOf::kNone).fragment_total;
  }
  EXPECT_LT(convex, siblings);
  EXPECT_LT(siblings, off);
}

// --- Several lights together ---

ShadowOptions together(KernelId kernel, MergeOf merge) {
  ShadowOptions options = options_for(kernel);
  options.method.point = MethodId::kSvbsp;
  options.method.options.merge = merge;
  options.output.combined = true;
  return options;
}

TEST(ConvexMerge, WhatOneLightCutInVainIsOnePieceAgain) {
  // Two suns: the shadows of two sheets cut the floor for each of them. What the same suns reach is
  // merged across the planes of either.
  Scene scene =
      under_the_sun({{"left", 0, 0, 1, 1, 1}, {"right", 1, 0, 2, 1, 2}, {"p", -1, -1, 3, 3, 0}});
  Light second = scene.lights[0];
  second.id = "second";
  second.position = {Number(1.0), Number(0.0), Number(1.0)};
  scene.lights.push_back(second);
  const auto own = Case::make(std::move(scene));
  const auto usual = compute_shadows(own->prepared(), together(KernelId::kPlane, MergeOf::kNone));
  const auto siblings =
      compute_shadows(own->prepared(), together(KernelId::kPlane, MergeOf::kSiblings));
  const auto convex =
      compute_shadows(own->prepared(), together(KernelId::kPlane, MergeOf::kConvex));
  ASSERT_TRUE(usual && siblings && convex);
  EXPECT_LT(convex->combined.size(), siblings->combined.size());
  EXPECT_LE(siblings->combined.size(), usual->combined.size());
  EXPECT_EQ(judge(*own, *convex).verdict, oracle::Verdict::kIdentical);
}

TEST(ConvexMerge, SetsOfLightsStayTrueOnExactKernels) {
  std::uint64_t before = 0, after = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const auto& family = fuzz::families()[seed % fuzz::families().size()];
    if (family.name == "MixedMagnitudes") continue;  // thousands of digits
    Scene scene = family.make(seed);
    if (scene.vertices.size() < 3) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      Light& lamp = scene.lights.emplace_back();
      lamp.id = "more" + std::to_string(i);
      // In the planes of polygons, most often.
      for (std::size_t k = 0; k < 3; ++k) {
        lamp.position[k] = scene.vertices[(7 * seed + 3 * i + k) % scene.vertices.size()][k];
      }
    }
    const auto own = Case::make(std::move(scene));
    if (!own) continue;
    SCOPED_TRACE(family.name + " " + std::to_string(seed) + "\n" + text_of(own->scene()));
    for (const KernelId kernel : kExactKernels) {
      const auto siblings = compute_shadows(own->prepared(), together(kernel, MergeOf::kSiblings));
      const auto convex = compute_shadows(own->prepared(), together(kernel, MergeOf::kConvex));
      ASSERT_TRUE(siblings && convex);
      ASSERT_LE(convex->combined.size(), siblings->combined.size());
      before += siblings->combined.size();
      after += convex->combined.size();
      const oracle::Report report = judge(*own, *convex);
      ASSERT_EQ(report.verdict, oracle::Verdict::kIdentical) << report.reason;
    }
  }
  EXPECT_LT(after, before);
}

}  // namespace
}  // namespace gnomon::test
