// SPDX-License-Identifier: GPL-3.0-or-later
// Blots: the order of sub-objects, what counts as one, and small scenes that need each of the rules
// that make outlines right: planes in common, cycles, blots that are absorbed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "algorithms/blots/blot_clipping.h"
#include "algorithms/blots/convex_solids.h"
#include "algorithms/blots/hiding_order.h"
#include "algorithms/run/compute.h"
#include "exact_check.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/oracle/witness_check.h"
#include "gnomon/scene/generate.h"
#include "method_variants.h"
#include "scene/base/random.h"
#include "witness_check.h"

namespace gnomon::test {
namespace {

using enum Counter;
using fuzz::ScenePen;
using fuzz::Triple;
using fuzz::operator+;
using fuzz::operator*;

const std::vector<std::string> kVariants = {"blots", "blots:sectors=off", "blots:outlines=whole",
                                            "blots:sectors=off,outlines=whole"};

// --- The order ---

TEST(HidingOrder, GroupsAreTheRings) {
  EXPECT_EQ(hiding_order(0, {}).groups(), 0u);
  EXPECT_EQ(hiding_order(3, {}).groups(), 3u);
  const std::vector<HidingPair> chain = {{2, 1}, {1, 0}, {2, 0}};
  EXPECT_THAT(hiding_order(3, chain).members, testing::ElementsAre(2, 1, 0));
  const std::vector<HidingPair> ring = {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {4, 0}};
  const HidingOrder order = hiding_order(5, ring);
  EXPECT_THAT(order.members, testing::ElementsAre(4, 0, 1, 2, 3));
  EXPECT_THAT(order.start, testing::ElementsAre(0, 1, 4, 5));
}

TEST(HidingOrder, NothingOfALaterGroupHidesAnEarlierOne) {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    const auto count = static_cast<std::uint32_t>(random.between(1, 12));
    std::vector<HidingPair> pairs;
    for (auto n = random.between(0, 20); n > 0; --n) {
      const auto a = static_cast<std::uint32_t>(random.below(count));
      const auto b = static_cast<std::uint32_t>(random.below(count));
      if (a != b) pairs.push_back({a, b});
    }
    // What can be reached from what, by the definition.
    std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count, false));
    for (const HidingPair& pair : pairs) reaches[pair.nearer][pair.farther] = true;
    for (std::uint32_t k = 0; k < count; ++k) {
      for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = 0; j < count; ++j) {
          if (reaches[i][k] && reaches[k][j]) reaches[i][j] = true;
        }
      }
    }
    const HidingOrder order = hiding_order(count, pairs);
    std::vector<std::size_t> group_of(count, count);
    for (std::size_t g = 0; g < order.groups(); ++g) {
      for (const std::uint32_t member : order.group(g)) group_of[member] = g;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      ASSERT_LT(group_of[i], order.groups());
      for (std::uint32_t j = 0; j < count; ++j) {
        if (i == j) continue;
        ASSERT_EQ(group_of[i] == group_of[j], reaches[i][j] && reaches[j][i]);
        if (reaches[i][j]) {
          ASSERT_LE(group_of[i], group_of[j]);
        }
      }
    }
  }
}

// --- Scenes ---

std::unique_ptr<Case> made(ScenePen& pen) {
  auto scene = Case::make(pen.take());
  if (!scene) throw std::runtime_error("cannot be prepared");
  return scene;
}
void add_quad(ScenePen& pen, std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1,
              std::int64_t z) {
  pen.polygon({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
}
ShadowOptions options_by(const std::string& method, KernelId kernel = KernelId::kPlane) {
  const Expected<MethodSelection> selection = parse_method(method);
  if (!selection) throw std::runtime_error(to_string(selection.error()));
  ShadowOptions options = with_method(options_for(kernel), *selection);
  options.tuning.jobs = 1;
  return options;
}
WorkCounts counts_of(const Case& scene, const std::string& method) {
  const auto result = compute_shadows(scene.prepared(), options_by(method));
  if (!result) throw std::runtime_error(to_string(result.error()));
  WorkCounts sum;
  for (const LightResult& light : result->lights) sum += light.work;
  return sum;
}
/// Lit fractions of the parts under all lights, with rules turned around.
std::vector<mpq_class> lit(const Case& scene, const std::string& method, KernelId kernel,
                           const Rules& rules = {}) {
  const auto result = compute_with(scene.prepared(), options_by(method, kernel), rules);
  if (!result) throw std::runtime_error(to_string(result.error()));
  std::vector<mpq_class> fractions;
  for (const LightResult& light : result->lights) {
    for (const ExactFractions& own : light.exact_fractions) fractions.push_back(own.lit);
  }
  return fractions;
}

/// On every exact kernel by every variant the fractions are those of svbsp, fragments are what the
/// oracle calls identical, and witnesses hold, also those that are several polygons together.
void expect_right(const Case& scene) {
  const std::vector<mpq_class> right = lit(scene, "svbsp", KernelId::kPlane);
  for (const KernelId kernel : kExactKernels) {
    for (const std::string& method : kVariants) {
      SCOPED_TRACE(method + " on " + std::string(kernel_info(kernel).name));
      const auto result = compute_shadows(scene.prepared(), options_by(method, kernel));
      ASSERT_TRUE(result) << to_string(result.error());
      std::vector<mpq_class> own;
      for (const LightResult& light : result->lights) {
        for (const ExactFractions& fractions : light.exact_fractions) own.push_back(fractions.lit);
      }
      ASSERT_EQ(own, right);
      ASSERT_EQ(find_false_witness(scene, *result), "");
      ASSERT_EQ(judge(scene, *result).verdict, oracle::Verdict::kIdentical);
      oracle::WitnessOptions strict;
      strict.tolerance = 0;
      const auto report = oracle::check_witnesses(scene.scene(), scene.prepared(),
                                                  claims_of(scene, *result), strict);
      ASSERT_EQ(report.violations, 0u) << report.findings.front().text;
    }
  }
}

// --- Solids ---

TEST(Blots, ABoxIsOneSubObject) {
  ScenePen pen;
  pen.box({0, 0, 0}, {4, 4, 4});
  add_quad(pen, -20, -20, 20, 20, -2);
  pen.sun({1, 2, 3});
  const auto scene = made(pen);
  const WorkCounts counts = counts_of(*scene, "blots");
  EXPECT_EQ(counts[kSolids], 1u);
  EXPECT_EQ(counts[kSubObjects], 2u);
  EXPECT_EQ(counts[kHidingPairs], 1u);
  EXPECT_EQ(counts[kCycles], 0u);
  // The box is before all blots; the outline is one blot, and the floor's holds and absorbs it.
  EXPECT_EQ(counts[kBoxShortcuts], 1u);
  EXPECT_EQ(counts[kBlots], 2u);
  EXPECT_EQ(counts[kAbsorbed], 1u);
  EXPECT_EQ(counts[kBlotCuts], 1u);
  expect_right(*scene);
  const auto result = compute_shadows(scene->prepared(), options_by("blots"));
  ASSERT_EQ(result->lights[0].caster_sets.size(), 1u);
  EXPECT_EQ(result->lights[0].caster_sets[0].size(), 3u);
}

TEST(Blots, WhatIsNoSolidIsTakenByPolygons) {
  for (const int way : {0, 1, 2}) {
    ScenePen pen;
    pen.two_sided(way == 0).box({0, 0, 0}, {4, 4, 4}).two_sided(false);
    if (way == 1) pen.box({6, 0, 0}, {8, 4, 4}, true);
    add_quad(pen, -20, -20, 20, 20, -2);
    pen.sun({-3, -2, 5});
    Scene plain = pen.take();
    if (way == 2) plain.polygons[1].casts = false;
    const auto scene = Case::make(plain);
    EXPECT_EQ(counts_of(*scene, "blots")[kSolids], way == 1 ? 1u : 0u);
    expect_right(*scene);
  }
}

TEST(Blots, ALightInsideASolid) {
  ScenePen pen;
  pen.box({0, 0, 0}, {8, 8, 8});
  pen.box({2, 2, 2}, {3, 3, 3});
  pen.box({1, 1, 1}, {7, 7, 7}, true);
  pen.lamp({5, 4, 5});
  const auto scene = made(pen);
  expect_right(*scene);
  // Neither of the outer boxes is seen from outside.
  EXPECT_LE(counts_of(*scene, "blots:sectors=off")[kSolids], 12u);
}

TEST(Blots, ThreeBoxesThatShareFaces) {
  ScenePen pen;
  pen.box({0, 0, 0}, {2, 2, 2});
  pen.box({2, 0, 0}, {4, 2, 2});
  pen.box({0, 2, 0}, {2, 4, 2});
  add_quad(pen, -9, -9, 14, 14, -1);
  pen.lamp({5, 4, 7}).sun({1, 1, 2}).sun({0, 0, 1}).lamp({3, 3, 1});
  const auto scene = made(pen);
  EXPECT_GE(counts_of(*scene, "blots")[kSolids], 3u);
  expect_right(*scene);
}

TEST(Blots, ACycleOfBoxesIsTakenApart) {
  // Three beams, each above the next at one end and below the one before at the other.
  ScenePen pen;
  const auto beam = [&](const Triple& from, const Triple& along, const Triple& across,
                        const Triple& up) {
    const auto at = [&](int a, int b, int c) { return from + a * along + b * across + c * up; };
    const auto face = [&](std::vector<Triple> loop) { pen.polygon(loop); };
    face({at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
    face({at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)});
    face({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
    face({at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)});
    face({at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)});
    face({at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)});
  };
  beam({0, 0, 0}, {20, 0, 8}, {0, 2, 0}, {0, 0, 1});
  beam({16, -2, 0}, {0, 20, 8}, {-2, 0, 0}, {0, 0, 1});
  beam({18, 16, 0}, {-20, -14, 8}, {1, -2, 0}, {0, 0, 1});
  add_quad(pen, -20, -20, 40, 40, -3);
  pen.sun({0, 0, 1}).sun({1, -1, 12});
  Scene plain = pen.take();
  for (Polygon& polygon : plain.polygons) polygon.two_sided = false;
  const auto scene = Case::make(plain);
  ASSERT_TRUE(scene);
  EXPECT_GE(counts_of(*scene, "blots")[kCycles], 1u);
  expect_right(*scene);
}

TEST(Blots, SolidsThatGoThroughEachOther) {
  ScenePen pen;
  pen.box({0, 0, 0}, {6, 3, 3});
  pen.box({2, -2, 1}, {4, 5, 4});
  pen.box({-1, 1, 2}, {7, 2, 7});
  add_quad(pen, -20, -20, 20, 20, -2);
  pen.lamp({5, 4, 17}).sun({2, 1, 2});
  const auto scene = made(pen);
  EXPECT_GE(counts_of(*scene, "blots")[kCycles], 1u);
  expect_right(*scene);
}

// --- Planes in common ---

TEST(Blots, WhatLiesInAPlaneOfTheSolidIsNotInItsShadow) {
  // A tile in the plane of the box's top, over its front side as the sun sees it, and one over the
  // top; and a box of the same height beside it.
  ScenePen pen;
  pen.box({0, 0, 0}, {4, 4, 4});
  add_quad(pen, 1, -3, 3, 2, 4);
  pen.box({5, -1, 1}, {8, 3, 4});
  add_quad(pen, -20, -20, 20, 20, -2);
  pen.sun({0, -1, 2}).sun({1, -1, 1}).lamp({6, -5, 9});
  expect_right(*made(pen));
}

/// Under the sun: a small quad over a box; and one in the plane of the box's top. The outlines of
/// both hold that of the small one.
std::unique_ptr<Case> small_over_two_coplanar(bool with_last) {
  ScenePen pen;
  add_quad(pen, 1, 1, 3, 3, 9);
  pen.box({0, 0, 0}, {8, 8, 4});
  if (with_last) add_quad(pen, 0, 0, 10, 8, 4);
  pen.sun({0, 0, 1});
  return made(pen);
}

TEST(Blots, ABlotIsAbsorbedAfterItsHeirsPlanesReceived) {
  constexpr std::size_t kTop = 6, kLast = 7;
  const auto without = small_over_two_coplanar(false), with = small_over_two_coplanar(true);
  expect_right(*without);
  expect_right(*with);
  EXPECT_EQ(counts_of(*without, "blots")[kAbsorbed], 1u);
  Rules rules;
  rules.blots_absorbed_after_their_planes_received = false;
  for (const KernelId kernel : kExactKernels) {
    for (const std::string& method : kVariants) {
      const auto right = lit(*with, method, kernel), wrong = lit(*with, method, kernel, rules);
      EXPECT_EQ(right[kTop], mpq_class(15, 16)) << method;
      EXPECT_EQ(right[kLast], mpq_class(19, 20)) << method;
      // The first of the two takes the shadow of the other.
      EXPECT_EQ((wrong[kTop] == 1) + (wrong[kLast] == 1), 1) << method;
      EXPECT_EQ(lit(*without, method, kernel, rules), lit(*without, method, kernel)) << method;
    }
  }
}

TEST(Blots, WhatDoesNotCastMayLieBetweenABlotAndItsHeir) {
  ScenePen pen;
  add_quad(pen, 1, 1, 3, 3, 9);
  pen.box({0, 0, 0}, {8, 8, 4});
  pen.casts(false);
  add_quad(pen, 0, 0, 8, 8, 6);
  pen.sun({0, 0, 1}).lamp({2, 3, 20});
  const auto scene = made(pen);
  EXPECT_GE(counts_of(*scene, "blots")[kAbsorbed], 1u);
  expect_right(*scene);
}

// --- Scenes by rule ---

TEST(Blots, BoxesThatTouchAndOverlap) {
  std::uint64_t cycles = 0, absorbed = 0, solids = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    ScenePen pen;
    for (int i = 0; i < 4; ++i) {
      Triple low{}, high{};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = random.between(0, 4);
        high[k] = low[k] + random.between(1, 3);
      }
      pen.box(low, high);
    }
    add_quad(pen, random.between(-6, 2), -6, 12, 12, random.between(-1, 6));
    pen.lamp({3, 5, 11}).sun({2, 1, 3}).sun({0, 0, 1}).lamp({2, 2, 2});
    const auto scene = made(pen);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text_of(scene->scene()));
    if (seed < 5) {
      expect_right(*scene);
    } else {
      const auto right = lit(*scene, "svbsp", KernelId::kPlane);
      for (const std::string& method : kVariants) {
        ASSERT_EQ(lit(*scene, method, KernelId::kPlane), right) << method;
      }
    }
    if (HasFatalFailure()) return;
    const WorkCounts counts = counts_of(*scene, "blots");
    cycles += counts[kCycles];
    absorbed += counts[kAbsorbed];
    solids += counts[kSolids];
  }
  EXPECT_GT(cycles, 20u);
  EXPECT_GT(absorbed, 20u);
  EXPECT_GT(solids, 200u);
}

TEST(Blots, GroupsOfSolidsUnderSeveralLights) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto scene = Case::make(*generate("sub-objects", {{"n", 40}, {"light", 2}}, seed));
    ASSERT_TRUE(scene);
    const auto right = lit(*scene, "svbsp", KernelId::kPlane);
    for (const std::string& method : kVariants) {
      ASSERT_EQ(lit(*scene, method, KernelId::kPlane), right) << method;
    }
    const WorkCounts counts = counts_of(*scene, "blots");
    EXPECT_GE(counts[kSolids], 80u);
    ShadowOptions threads = options_by("blots"), small = threads;
    threads.tuning.jobs = 4;
    small.tuning.leaf_size = small.tuning.task_size = 1;
    const auto one = compute_shadows(scene->prepared(), options_by("blots"));
    const auto four = compute_shadows(scene->prepared(), threads);
    const auto cells = compute_shadows(scene->prepared(), small);
    ASSERT_TRUE(one && four && cells);
    for (std::size_t l = 0; l < one->lights.size(); ++l) {
      EXPECT_EQ(one->lights[l].exact_points, four->lights[l].exact_points);
      EXPECT_EQ(one->lights[l].caster_sets, four->lights[l].caster_sets);
      EXPECT_EQ(one->lights[l].work, four->lights[l].work);
      for (std::size_t i = 0; i < one->lights[l].parts.size(); ++i) {
        EXPECT_EQ(one->lights[l].exact_fractions[i].lit, cells->lights[l].exact_fractions[i].lit);
      }
    }
  }
}

TEST(Blots, ASceneWithoutSolids) {
  const auto scene = Case::make(*generate("quads", {{"n", 60}, {"light", 1}}, 3));
  const WorkCounts counts = counts_of(*scene, "blots:sectors=off");
  EXPECT_EQ(counts[kSolids], 0u);
  EXPECT_EQ(counts[kSubObjects], 61u);
  EXPECT_EQ(lit(*scene, "blots", KernelId::kPlane), lit(*scene, "svbsp", KernelId::kPlane));
  EXPECT_EQ(lit(*scene, "blots:sectors=off", KernelId::kPlane),
            lit(*scene, "svbsp", KernelId::kPlane));
}

TEST(Blots, PaintedOverDarkPolygons) {
  ScenePen pen;
  pen.box({0, 0, 0}, {4, 4, 4});
  add_quad(pen, -20, -20, 20, 20, -2);
  pen.lamp({-3, -2, 9});
  const auto scene = made(pen);
  const auto result = compute_shadows(scene->prepared(), options_by("blots:cover=overlay"));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->lights[0].background, LightState::kShadow);
  for (const Fragment& fragment : result->lights[0].fragments) {
    EXPECT_EQ(fragment.state, LightState::kLit);
  }
  EXPECT_EQ(judge(*scene, *result).verdict, oracle::Verdict::kIdentical);
}

}  // namespace
}  // namespace gnomon::test
