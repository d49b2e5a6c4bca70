// SPDX-License-Identifier: GPL-3.0-or-later
// RunControl::light_done: who takes the lights one by one gets what a kept result holds, in order,
// and can stop the run.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/shadows.h"
#include "method_variants.h"
#include "solve.h"

namespace gnomon::test {
namespace {

using fuzz::ScenePen;

/// Three squares, one above the other, under lights of all kinds that take turns.
Scene mixed_scene() {
  ScenePen pen;
  pen.two_sided(true);
  pen.polygon({{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}});
  pen.polygon({{-4, -4, 2}, {4, -4, 2}, {4, 4, 3}, {-4, 4, 3}});
  pen.polygon({{-1, -1, 5}, {3, -1, 5}, {3, 3, 5}, {-1, 3, 5}});
  pen.lamp({0, 1, 12});
  pen.panel({{-1, -1, 10}, {-1, 1, 10}, {1, 1, 10}, {1, -1, 10}});
  pen.sun({1, 2, 7});
  pen.lamp({3, -2, 20});
  pen.panel({{-1, 5, 9}, {-1, 7, 9}, {1, 7, 9}, {1, 5, 9}});
  pen.lamp({3, 3, -20});
  return pen.take();
}

void expect_same(const LightResult& a, const LightResult& b) {
  EXPECT_EQ(a.light, b.light);
  EXPECT_EQ(a.piece, b.piece);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.fragment_total, b.fragment_total);
  EXPECT_EQ(a.exact_points, b.exact_points);
  EXPECT_EQ(a.area_fractions.size(), b.area_fractions.size());
  ASSERT_EQ(a.parts.size(), b.parts.size());
  ASSERT_EQ(a.exact_fractions.size(), b.exact_fractions.size());
  ASSERT_EQ(a.exact_fractions.size(), a.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    EXPECT_EQ(a.parts[i].part, b.parts[i].part);
    EXPECT_EQ(a.exact_fractions[i].lit, b.exact_fractions[i].lit);
    EXPECT_EQ(a.exact_fractions[i].umbra, b.exact_fractions[i].umbra);
  }
}

struct Streamed {
  ShadowResult result;
  std::vector<LightResult> lights;
};

Streamed streamed(const PreparedScene& scene, ShadowOptions options) {
  Streamed found;
  options.control.light_done = [&](LightResult&& light) {
    found.lights.push_back(std::move(light));
    return true;
  };
  found.result = compute_shadows(scene, options).value();
  return found;
}

void expect_streamed_as_kept(const Case& scene, ShadowOptions options) {
  const ShadowResult kept = compute_shadows(scene.prepared(), options).value();
  const Streamed found = streamed(scene.prepared(), options);
  EXPECT_TRUE(found.result.lights.empty());
  EXPECT_EQ(found.result.algorithm, kept.algorithm);
  EXPECT_EQ(found.result.combined.size(), kept.combined.size());
  ASSERT_EQ(found.lights.size(), kept.lights.size());
  for (std::size_t i = 0; i < kept.lights.size(); ++i) {
    expect_same(found.lights[i], kept.lights[i]);
  }
}

TEST(StreamedLights, AreThoseOfAKeptResultByEveryMethod) {
  const auto scene = Case::make(mixed_scene());
  ASSERT_TRUE(scene);
  for (const MethodSelection& method : method_variants()) {
    SCOPED_TRACE(text_of(method));
    expect_streamed_as_kept(*scene, with_method(options_for(KernelId::kPlane), method));
  }
}

TEST(StreamedLights, ComeInTheOrderAskedFor) {
  const auto scene = Case::make(mixed_scene());
  ASSERT_TRUE(scene);
  ShadowOptions options = options_for(KernelId::kPlane);
  options.lights = {4, 2, 1, 0};
  const Streamed found = streamed(scene->prepared(), options);
  ASSERT_EQ(found.lights.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(found.lights[i].light, options.lights[i]);
  EXPECT_EQ(found.result.algorithm, "sectors+receiver");
}

TEST(StreamedLights, OfSeveralPiecesAndTogether) {
  const auto scene = Case::make(mixed_scene());
  ASSERT_TRUE(scene);
  ShadowOptions options = options_for(KernelId::kPlane);
  options.method.area = MethodId::kPieces;
  expect_streamed_as_kept(*scene, options);
  options.method.area = MethodId::kReceiver;
  options.output.combined = true;
  expect_streamed_as_kept(*scene, options);
  options.lights = {0, 2, 3};
  expect_streamed_as_kept(*scene, options);
}

TEST(StreamedLights, StopTheRun) {
  const auto scene = Case::make(mixed_scene());
  ASSERT_TRUE(scene);
  for (const MethodSelection& method : method_variants()) {
    for (unsigned most = 1; most <= 6; ++most) {
      ShadowOptions options = with_method(options_for(KernelId::kPlane), method);
      unsigned taken = 0;
      options.control.light_done = [&](LightResult&&) { return ++taken < most; };
      const auto result = compute_shadows(scene->prepared(), options);
      ASSERT_FALSE(result) << text_of(method);
      EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
      EXPECT_EQ(taken, most) << text_of(method);
    }
  }
}

TEST(StreamedLights, WithoutExactFractionsHaveNone) {
  const auto scene = Case::make(mixed_scene());
  ASSERT_TRUE(scene);
  for (const LightResult& light : streamed(scene->prepared(), ShadowOptions{}).lights) {
    EXPECT_TRUE(light.exact_fractions.empty());
    EXPECT_FALSE(light.parts.empty());
  }
}

}  // namespace
}  // namespace gnomon::test
