// SPDX-License-Identifier: GPL-3.0-or-later
// Trees that grow while receivers are filtered down them (merged:interleaved=on): the classes of
// finished trees, on cycles, on tiles of one plane, and where planes of polygons cut the light, so
// that no order is right for all of it; and that receivers wait there alone. Besides, end caps. The
// oracle judges all of it in area_suite_test.cc and method_suite_test.cc, too.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "area_check.h"
#include "exact_check.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/oracle/witness_check.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // pens

/// A panel that looks down from height z.
std::vector<Triple> ceiling(std::int64_t half, std::int64_t z) {
  return {{-half, -half, z}, {-half, half, z}, {half, half, z}, {half, -half, z}};
}

void floor(ScenePen& pen) { pen.polygon({{-40, -40, 0}, {40, -40, 0}, {40, 40, 0}, {-40, 40, 0}}); }

/// Three upright boards below the light, whose planes cut it, and a sheet on either side: the floor
/// between two boards is before them as seen from the light's middle, and yet in the shadow of each
/// from a part of the light.
Scene boards_below_the_light() {
  ScenePen pen;
  floor(pen);
  pen.two_sided(true);
  for (const std::int64_t x : {-4, 0, 4}) {
    pen.polygon({{x, -8, 2}, {x, 8, 2}, {x, 8, 7}, {x, -8, 7}});
  }
  pen.polygon({{-8, -4, 8}, {-2, -4, 8}, {-2, 4, 8}, {-8, 4, 8}});
  pen.polygon({{2, -4, 10}, {8, -4, 10}, {8, 4, 10}, {2, 4, 10}});
  return pen.panel(ceiling(6, 20)).take();
}

/// Four bars, each under the next at one end and over it at the other.
Scene cycle() {
  ScenePen pen;
  floor(pen);
  pen.two_sided(true);
  pen.polygon({{-8, -6, 6}, {8, -6, 9}, {8, -4, 9}, {-8, -4, 6}});
  pen.polygon({{6, -8, 6}, {8, -8, 6}, {8, 8, 9}, {6, 8, 9}});
  pen.polygon({{8, 4, 6}, {8, 6, 6}, {-8, 6, 9}, {-8, 4, 9}});
  pen.polygon({{-8, 8, 6}, {-6, 8, 6}, {-6, -8, 9}, {-8, -8, 9}});
  return pen.panel(ceiling(5, 16)).take();
}

/// Tiles of one plane that overlap, under another sheet and over the floor.
Scene coplanar_tiles() {
  ScenePen pen;
  floor(pen);
  pen.two_sided(true);
  for (std::int64_t i = 0; i < 4; ++i) {
    pen.polygon({{3 * i - 8, -6, 5}, {3 * i - 2, -6, 5}, {3 * i - 2, 4 + i, 5}, {3 * i - 8, 4, 5}});
  }
  pen.polygon({{-3, -3, 9}, {3, -3, 9}, {3, 3, 9}, {-3, 3, 9}});
  return pen.panel(ceiling(4, 14)).take();
}

/// Anything on a small lattice: polygons that cut the light, touch it, and go through each other.
Scene soup(std::uint64_t seed) {
  Random random(seed);
  const std::int64_t size = seed % 2 == 0 ? 3 : 6;
  const auto loop = [&]() -> std::vector<Triple> {
    for (;;) {
      std::array<Triple, 3> p{};
      for (Triple& point : p) {
        point = {random.between(0, size), random.between(0, size), random.between(0, size)};
      }
      if (is_zero(cross(p[1] - p[0], p[2] - p[0]))) continue;
      if (random.chance(1, 2)) return {p[0], p[1], p[2]};
      return {p[0], p[1], p[1] + (p[2] - p[0]), p[2]};
    }
  };
  ScenePen pen;
  for (int i = 0; i < 8; ++i) {
    pen.two_sided(random.chance(1, 2)).casts(!random.chance(1, 10));
    pen.polygon(loop());
  }
  pen.lamp({random.between(0, size), random.between(0, size), random.between(0, size)});
  return pen.panel(loop()).take();
}

ShadowOptions merged(KernelId kernel, bool interleaved, bool caps = false) {
  ShadowOptions options = options_for(kernel);
  options.tuning.jobs = 1;
  options.method.point = options.method.area = MethodId::kMerged;
  options.method.options.interleaved = interleaved;
  options.method.options.caps = caps;
  return options;
}

std::string classes_of(const ShadowResult& result) {
  std::string text;
  for (const LightResult& light : result.lights) {
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      const PartResult& part = light.parts[i];
      const ExactFractions& exact = light.exact_fractions[i];
      text += std::to_string(part.part) + (part.side == Side::kFront ? "f " : "b ") +
              exact.lit.get_str() + " " + exact.penumbra.get_str() + " " + exact.umbra.get_str() +
              " " + exact.shadow.get_str() + "\n";
    }
  }
  return text;
}

void expect_same_classes(Scene scene, bool oracle = true) {
  std::string why;
  const auto own = Case::make(std::move(scene), &why);
  ASSERT_TRUE(own) << why;
  const auto finished = compute_shadows(own->prepared(), merged(KernelId::kPlane, false));
  ASSERT_TRUE(finished);
  for (const KernelId kernel : kExactKernels) {
    for (const bool caps : {false, true}) {
      const auto interleaved = compute_shadows(own->prepared(), merged(kernel, true, caps));
      ASSERT_TRUE(interleaved) << to_string(interleaved.error());
      ASSERT_EQ(classes_of(*interleaved), classes_of(*finished)) << text_of(own->scene());
      for (const LightResult& light : interleaved->lights) ASSERT_EQ(light.dropped_slivers, 0u);
      if (!oracle || kernel != KernelId::kPlane) continue;
      ASSERT_EQ(judge(*own, *interleaved).verdict, oracle::Verdict::kIdentical)
          << text_of(own->scene());
      oracle::WitnessOptions exactly;
      exactly.tolerance = 0;
      const auto witnesses = oracle::check_witnesses(own->scene(), own->prepared(),
                                                     claims_of(*own, *interleaved), exactly);
      ASSERT_EQ(witnesses.violations, 0u) << witnesses.findings.front().text;
    }
  }
}

TEST(Interleaved, APlaneThatCutsTheLightHasNoOrder) {
  expect_same_classes(boards_below_the_light());
}
TEST(Interleaved, CyclesOfOcclusion) { expect_same_classes(cycle()); }
TEST(Interleaved, TilesOfOnePlane) { expect_same_classes(coplanar_tiles()); }
TEST(Interleaved, Soups) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    if (!Case::make(soup(seed))) continue;
    SCOPED_TRACE(seed);
    expect_same_classes(soup(seed), seed % 4 == 0);
    if (HasFatalFailure()) return;
  }
}

TEST(Interleaved, FewerNodesAreThereWhenReceiversComeAndTheSameAreMade) {
  const auto own = Case::make(coplanar_tiles());
  const auto off = compute_shadows(own->prepared(), merged(KernelId::kPlane, false)).value();
  const auto on = compute_shadows(own->prepared(), merged(KernelId::kPlane, true)).value();
  const WorkCounts &all = off.lights[0].work, &grown = on.lights[0].work;
  EXPECT_EQ(grown[Counter::kVolumes], all[Counter::kVolumes]);
  EXPECT_EQ(grown[Counter::kVolumePlanes], all[Counter::kVolumePlanes]);
  EXPECT_GT(grown[Counter::kNodes], 0u);
  EXPECT_GT(grown[Counter::kDepth], 0u);
  EXPECT_EQ(all[Counter::kScenePieces], 0u);
  EXPECT_GT(grown[Counter::kScenePieces], 0u);
}

TEST(Interleaved, PiecesOfALightToo) {
  // No plane cuts a piece of the light: this is the order of the paper.
  const auto own = Case::make(boards_below_the_light());
  ShadowOptions options = merged(KernelId::kPlane, false);
  options.method.area = MethodId::kPieces;
  const auto off = compute_shadows(own->prepared(), options);
  options.method.options.interleaved = true;
  const auto on = compute_shadows(own->prepared(), options);
  ASSERT_TRUE(off && on);
  EXPECT_GT(off->lights.size(), 1u);
  EXPECT_EQ(classes_of(*on), classes_of(*off));
}

TEST(Interleaved, LightsTogetherGoDownFinishedTrees) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const auto own = Case::make(soup(seed));
    if (!own) continue;
    ShadowOptions options = merged(KernelId::kPlane, true, seed % 2 == 1);
    options.output.combined = true;
    const auto result = compute_shadows(own->prepared(), options);
    ASSERT_TRUE(result) << to_string(result.error());
    ASSERT_EQ(judge(*own, *result).verdict, oracle::Verdict::kIdentical) << text_of(own->scene());
  }
}

TEST(Interleaved, StopsAtLimits) {
  const auto own = Case::make(cycle());
  ShadowOptions options = merged(KernelId::kPlane, true);
  options.limits.fragments = 1;
  EXPECT_EQ(compute_shadows(own->prepared(), options).error().code, ErrorCode::kLimit);
  options.limits.fragments = 1'000'000;
  const std::atomic<bool> interrupted = true;
  options.control.interrupted = &interrupted;
  EXPECT_EQ(compute_shadows(own->prepared(), options).error().code, ErrorCode::kInterrupted);
}

// --- End caps ---

TEST(EndCaps, VolumesThatReachNothingAreLeftOut) {
  // The upper sheet's shadow falls beside the small lower one, and on nothing else.
  ScenePen pen;
  pen.polygon({{-2, -2, 8}, {2, -2, 8}, {2, 2, 8}, {-2, 2, 8}});
  pen.polygon({{30, 30, 0}, {34, 30, 0}, {34, 34, 0}, {30, 34, 0}});
  const auto own = Case::make(pen.panel(ceiling(1, 20)).take());
  const auto whole = compute_shadows(own->prepared(), merged(KernelId::kPlane, false)).value();
  const auto capped =
      compute_shadows(own->prepared(), merged(KernelId::kPlane, false, true)).value();
  EXPECT_EQ(classes_of(capped), classes_of(whole));
  EXPECT_GT(whole.lights[0].work[Counter::kNodes], 0u);
  EXPECT_EQ(capped.lights[0].work[Counter::kNodes], 0u);
}

}  // namespace
}  // namespace gnomon::test
