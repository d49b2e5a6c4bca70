// SPDX-License-Identifier: GPL-3.0-or-later
// What the systems of the papers say of their work, against counts worked out by hand on scenes of
// a few quads under the sun (0, 0, 1), where every number can be seen; and the smallest scenes that
// need each rule of theirs, with the rule turned around.
#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "algorithms/run/compute.h"
#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/scene/read.h"
#include "method_variants.h"

namespace gnomon::test {
namespace {

using fuzz::ScenePen;

void add_quad(ScenePen& pen, std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1,
              std::int64_t z) {
  pen.polygon({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
}
std::unique_ptr<Case> under_sun(ScenePen& pen) {
  pen.sun({0, 0, 1});
  auto scene = Case::make(pen.take());
  if (!scene) throw std::runtime_error("cannot be prepared");
  return scene;
}

ShadowOptions options_by(const std::string& method, KernelId kernel = KernelId::kPlane) {
  const Expected<MethodSelection> selection = parse_method(method);
  if (!selection) throw std::runtime_error(to_string(selection.error()));
  ShadowOptions options = with_method(options_for(kernel), *selection);
  options.tuning.jobs = 1;
  return options;
}
LightResult solved(const Case& scene, const std::string& method,
                   KernelId kernel = KernelId::kPlane) {
  Expected<ShadowResult> result = compute_shadows(scene.prepared(), options_by(method, kernel));
  if (!result) throw std::runtime_error(to_string(result.error()));
  return std::move(result->lights.at(0));
}

/// Fails where a counter of the method differs from `expected`. Those not named are not looked at.
void expect_counts(const Case& scene, const std::string& method,
                   const std::vector<std::pair<Counter, std::uint64_t>>& expected) {
  for (const KernelInfo& kernel : kernel_list()) {
    const LightResult result = solved(scene, method, kernel.id);
    for (const auto& [counter, count] : expected) {
      EXPECT_EQ(result.work[counter], count)
          << method << " on " << kernel.name << ": " << counter_info(counter).name;
    }
  }
}

// --- k quads over a ground ---

/// k quads [i + 1, i + 3] x [1, 3] at z = i + 1, so that each overlaps the next in half of it and
/// touches the one after that, over the ground [0, 8] x [0, 8]. Seen from the sun they come in the
/// order k - 1, ..., 0, ground. m = k + 1 polygons, none of which the scene BSP splits.
std::unique_ptr<Case> steps(std::int64_t k) {
  ScenePen pen;
  for (std::int64_t i = 0; i < k; ++i) add_quad(pen, i + 1, 1, i + 3, 3, i + 1);
  add_quad(pen, 0, 0, 8, 8, 0);
  return under_sun(pen);
}

class Steps : public testing::TestWithParam<std::uint64_t> {
 protected:
  const std::uint64_t k = GetParam();
  const std::unique_ptr<Case> scene = steps(static_cast<std::int64_t>(k));
};

using enum Counter;

TEST_P(Steps, Basic) {
  // No quad holds another, so that each target is tested against all before it: m (m - 1) / 2.
  // Quads that are two or more apart have no area in common: (k - 1) (k - 2) / 2 pairs are null.
  // A quad loses half of itself to the one before by one cut. The ground is cut by all four edges
  // of the first quad; of the four pieces left only [0, k] x [1, 3] meets the next one, and loses
  // to it what is beyond one edge, and so on. The ground casts at last, and all quads are inside
  // its volume.
  expect_counts(*scene, "basic",
                {{kScenePieces, k + 1},
                 {kVolumes, k + 1},
                 {kTests, k * (k + 1) / 2},
                 {kNulled, (k - 1) * (k - 2) / 2},
                 {kCovered, 0},
                 {kDied, k},
                 {kClips, (k - 1) + 4 + (k - 1)},
                 {kShadowPolygons, (k - 1) + k}});
}

TEST_P(Steps, BasicWithoutPruning) {
  expect_counts(*scene, "basic:prune=off",
                {{kVolumes, k + 1},
                 {kTests, k * (k + 1) / 2},
                 {kCovered, 0},
                 {kDied, 0},
                 {kClips, (k - 1) + 4 + (k - 1)},
                 {kShadowPolygons, (k - 1) + k}});
}

TEST_P(Steps, BasicOverlayHasOneShadowPolygonAPair) {
  // k - 1 pairs of neighbours, k of a quad and the ground; each volume cuts the whole ground.
  expect_counts(*scene, "basic:cover=overlay",
                {{kTests, k * (k + 1) / 2},
                 {kNulled, (k - 1) * (k - 2) / 2},
                 {kClips, (k - 1) + 4 * k},
                 {kShadowPolygons, (k - 1) + k}});
  const LightResult result = solved(*scene, "basic:cover=overlay");
  EXPECT_EQ(result.cover, Cover::kOverlay);
  EXPECT_EQ(result.background, LightState::kLit);
  ASSERT_EQ(result.fragments.size(), (k - 1) + k);
  for (const PartResult& part : result.parts) {
    std::vector<std::uint32_t> casters;
    for (std::uint32_t i = 0; i < part.fragment_count; ++i) {
      const Fragment& fragment = result.fragments[part.first_fragment + i];
      EXPECT_EQ(fragment.state, LightState::kShadow);
      EXPECT_EQ(fragment.count, 4u);
      casters.push_back(fragment.caster);
    }
    // Nearest first: the next quad; on the ground all of them.
    std::vector<std::uint32_t> expected;
    if (part.part == k) {
      for (std::uint64_t i = k; i > 0; --i) expected.push_back(static_cast<std::uint32_t>(i - 1));
    } else if (part.part + 1 < k) {
      expected.push_back(part.part + 1);
    }
    EXPECT_EQ(casters, expected) << "part " << part.part;
  }
}

TEST_P(Steps, TilingWithOneTile) {
  // The tile is the ground. Each volume makes an entry in it; the ground closes it.
  expect_counts(*scene, "tiling:tiles=1",
                {{kScenePieces, k + 1},
                 {kVolumes, k + 1},
                 {kTests, k * (k + 1) / 2},
                 {kNulled, (k - 1) * (k - 2) / 2},
                 {kDied, k},
                 {kClips, (k - 1) + 4 + (k - 1)},
                 {kShadowPolygons, (k - 1) + k},
                 {kTileWrites, k + 1},
                 {kClosedTiles, 1},
                 {kMeanMet, 1'000'000},
                 {kFirstQuartileMet, 1'000'000},
                 {kMedianMet, 1'000'000},
                 {kThirdQuartileMet, 1'000'000}});
}

TEST_P(Steps, TilingWithEightTiles) {
  // Tiles are unit squares. A quad holds four of them, two of which the one before has closed: 4
  // writes for the first, 2 for each other, and as many closed tiles, 2 k + 2. So a quad meets the
  // one before alone, and the ground each of them in some tile: (k - 1) + k tests, none in vain.
  // The ground kills all quads, takes over their tiles, and closes the others: 64 writes.
  expect_counts(*scene, "tiling:tiles=8",
                {{kVolumes, k + 1},
                 {kTests, (k - 1) + k},
                 {kNulled, 0},
                 {kDied, k},
                 {kClips, (k - 1) + 4 + (k - 1)},
                 {kShadowPolygons, (k - 1) + k},
                 {kTileWrites, 2 * k + 2 + 64},
                 {kClosedTiles, 64}});
}

TEST_P(Steps, SvbspFull) {
  // The first quad hangs its 4 edges and its support plane. What of the next is outside hangs 3
  // edges (the fourth is the first quad's) and a support plane. The ground hangs 3 edges before the
  // first edge of the first quad, 2 beside the second, 2 behind the third, and 1 behind the last
  // edge of the last quad, each with its support plane: 4 + 3 + 3 + 2.
  expect_counts(
      *scene, "svbsp-full",
      {{kVolumes, k + 1}, {kNodes, 5 + 4 * (k - 1) + 12}, {kShadowPolygons, (k - 1) + k}});
  // In the order of the file the first quad is the farthest, and nothing but left and right changes
  // for the quads.
  expect_counts(*scene, "svbsp-full:order=file", {{kVolumes, k + 1}});
}

TEST_P(Steps, TwoPass) {
  // The first list has all polygons. Its nearest quad cuts the next quad once and the ground four
  // times; the next list has the k - 1 other quads and the ground's 4 pieces. Its clip piece cuts
  // the next quad and one piece of the ground, once each; so do all but the last, which cuts the
  // ground alone. Four pieces of the ground are left, which clip nothing of each other: 4 lists.
  // Nothing is nearer than a clip piece, so that there is never more than one list to come.
  for (const std::string method : {"two-pass:cells=off", "two-pass"}) {
    expect_counts(*scene, method,
                  {{kClips, 4 + 2 * (k - 1)},
                   {kLists, k + 4},
                   {kLongestList, k + 3},
                   {kDeepestStack, 1},
                   {kShadowPolygons, (k - 1) + k}});
  }
}

INSTANTIATE_TEST_SUITE_P(SystemCounts, Steps, testing::Range<std::uint64_t>(1, 6),
                         [](const auto& info) { return "K" + std::to_string(info.param); });

TEST(SystemCounts, SharesOfVolumesThatTargetsMeet) {
  // Four quads in 8 x 8 tiles: the second, third and fourth meet 1 of 1, 2 and 3 volumes; the
  // ground meets 4 of 4. The first meets no volume, since there is none, and does not count. In
  // millionths, sorted: 333333, 500000, 1000000, 1000000.
  expect_counts(*steps(4), "tiling:tiles=8",
                {{kMeanMet, 708'333},
                 {kFirstQuartileMet, 333'333},
                 {kMedianMet, 500'000},
                 {kThirdQuartileMet, 1'000'000}});
}

TEST(SystemCounts, DepthOfTheTreeOfFullVolumes) {
  // One quad: 5 nodes in a chain. Of the ground's chains those behind its third and its fourth edge
  // reach deepest: 3 + 3 and 4 + 2.
  expect_counts(*steps(1), "svbsp-full", {{kDepth, 6}});
  // A second quad hangs 3 + 1 nodes behind the first one's last edge.
  ScenePen pen;
  add_quad(pen, 1, 1, 3, 3, 1);
  add_quad(pen, 2, 1, 4, 3, 2);
  expect_counts(*under_sun(pen), "svbsp-full", {{kNodes, 9}, {kDepth, 8}});
}

TEST(SystemCounts, AListIsHandedDown) {
  // A slants from z = 5 at x = 0 to z = 0 at x = 5, and has the nearest vertex. B at z = 3 is
  // nearer where it is, over x in [3, 4], y in [1, 2]; D is far off. Lists: all three, clipped by
  // A: D is outside, B is nearer and is handed down with A (two lists wait); A and B, clipped by B,
  // whose four edges cut A; then A's four pieces outside, each of which clips nothing; and D.
  ScenePen pen;
  pen.polygon({{0, 0, 5}, {5, 0, 0}, {5, 5, 0}, {0, 5, 5}});
  add_quad(pen, 3, 1, 4, 2, 3);
  add_quad(pen, 10, 10, 11, 11, 0);
  const auto scene = under_sun(pen);
  expect_counts(*scene, "two-pass:cells=off",
                {{kLists, 1 + 1 + 4 + 1},
                 {kClips, 4},
                 {kLongestList, 4},
                 {kDeepestStack, 2},
                 {kShadowPolygons, 1}});
}

// --- Pruning ---

/// k squares around one axis, the nearest first: each larger than the one before, or smaller; under
/// them a larger ground.
std::unique_ptr<Case> pyramid(std::int64_t k, bool growing) {
  ScenePen pen;
  for (std::int64_t i = 1; i <= k; ++i) {
    const std::int64_t half = growing ? i : k + 1 - i;
    add_quad(pen, -half, -half, half, half, k + 1 - i);
  }
  add_quad(pen, -k - 1, -k - 1, k + 1, k + 1, 0);
  return under_sun(pen);
}

TEST(SystemCounts, VolumesDieInsideALaterOne) {
  // Each square is tested against the one before alone, whose volume then dies; the ground kills
  // the last. Each is cut by four edges.
  for (std::uint64_t k = 1; k <= 5; ++k) {
    const auto scene = pyramid(static_cast<std::int64_t>(k), true);
    for (const std::string method : {"basic", "tiling:tiles=1"}) {
      expect_counts(*scene, method,
                    {{kVolumes, k + 1},
                     {kTests, k},
                     {kDied, k},
                     {kCovered, 0},
                     {kClips, 4 * k},
                     {kShadowPolygons, k}});
    }
    expect_counts(*scene, "basic:prune=off",
                  {{kVolumes, k + 1}, {kTests, k * (k + 1) / 2}, {kDied, 0}, {kCovered, 0}});
  }
}

TEST(SystemCounts, CoveredTargetsCastNothing) {
  // The first square holds all others: one test each, no volume, one shadow polygon; the ground is
  // cut by its four edges and kills it.
  for (std::uint64_t k = 1; k <= 5; ++k) {
    const auto scene = pyramid(static_cast<std::int64_t>(k), false);
    for (const std::string method : {"basic", "tiling:tiles=1"}) {
      expect_counts(*scene, method,
                    {{kVolumes, 2},
                     {kTests, k},
                     {kDied, 1},
                     {kCovered, k - 1},
                     {kClips, 4},
                     {kShadowPolygons, k}});
    }
    expect_counts(*scene, "basic:prune=off",
                  {{kVolumes, k + 1}, {kTests, k * (k + 1) / 2}, {kDied, 0}, {kCovered, 0}});
  }
}

TEST(SystemCounts, WithoutPruningEveryPairIsTested) {
  // 1992, sec. 3: n (n + 1) / 2 with the light's own volume; of m pieces no two of which are
  // coplanar, and all of which cast, m (m - 1) / 2. With pruning never more.
  unsigned checked = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Scene made = fuzz::family_by_name("Generic").make(seed);
    for (Polygon& polygon : made.polygons) polygon.casts = true;
    const auto scene = Case::make(std::move(made));
    if (!scene) continue;
    for (const bool prune : {false, true}) {
      ShadowOptions options = options_by("basic");
      options.method.options.prune = prune;
      const auto result = compute_shadows(scene->prepared(), options);
      ASSERT_TRUE(result);
      for (const LightResult& light : result->lights) {
        const std::uint64_t m = light.work[kScenePieces];
        if (m != light.facing_parts) continue;  // two pieces of a part are coplanar
        ++checked;
        if (prune) {
          EXPECT_LE(light.work[kTests], m * (m - 1) / 2) << seed;
        } else {
          EXPECT_EQ(light.work[kTests], m * (m - 1) / 2) << seed;
        }
      }
    }
  }
  EXPECT_GT(checked, 100u);
}

// Found by a campaign on epick: points that were rounded lie on both sides of each other's planes,
// and loops that cut each other gained corners for minutes. Lists end when 256 n^2 + 2^15 corners
// have been asked about an edge, n = 4 polygons; epick makes 229 cuts by then.
TEST(SystemCounts, RoundedListsThatContradictEachOtherEnd) {
  const auto scene = Case::make(
      parse_scene(R"({"format": "gnomon-scene", "version": 1, "two_sided": true, "vertices": [
        [0,9,0], [-4,-9,0], [-4,-10,0], [-4,7,-4], [6,-5,4], [6,-4,4], [-4,8,-4], [3,-4,9],
        [-1,2,-9], [-2,2,-10], [2,-4,8], [11,-10,7], [-7,8,-3], [-8,9,-3], [10,-9,7]],
        "polygons": [{"loop": [0,1,2]}, {"loop": [3,4,5,6]}, {"loop": [7,8,9,10]},
                     {"loop": [11,12,13,14]}],
        "lights": [{"id": "sun", "type": "directional", "to_light": [-2,-2,3]}]})",
                  "contradictions.json")
          .value()
          .scene);
  ASSERT_TRUE(scene);
  EXPECT_EQ(check_methods(*scene), "");
  for (const KernelInfo& kernel : kernel_list()) {
    if (kernel.exact || !has_kernel(kernel.id)) continue;
    for (const std::string method : {"two-pass", "two-pass:cells=off"}) {
      EXPECT_LE(solved(*scene, method, kernel.id).work[Counter::kClips], (256 * 16 + (1 << 15)) / 2)
          << kernel.name;
    }
  }
}

TEST(SystemCounts, OneTileTestsWhatBasicTests) {
  // Under a sun one tile holds everything, and only what holds all of it closes it.
  unsigned checked = 0;
  for (const std::string family : {"Generic", "Crossing", "CoplanarTiles", "SmallLattice"}) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      Scene made = fuzz::family_by_name(family).make(seed);
      std::erase_if(made.lights, [](const Light& light) { return light.is_point(); });
      if (made.lights.empty()) continue;
      const auto scene = Case::make(std::move(made));
      if (!scene) continue;
      const LightResult tiling = solved(*scene, "tiling:tiles=1");
      if (tiling.work[kClosedTiles] != 0) continue;
      ++checked;
      const LightResult basic = solved(*scene, "basic");
      for (const Counter counter :
           {kScenePieces, kVolumes, kTests, kCovered, kDied, kClips, kNulled, kShadowPolygons}) {
        EXPECT_EQ(tiling.work[counter], basic.work[counter])
            << family << " seed " << seed << ": " << counter_info(counter).name;
      }
    }
  }
  EXPECT_GT(checked, 50u);
}

// --- Rules ---

/// The lit fraction of each polygon, by its index.
std::vector<mpq_class> lit(const Case& scene, const std::string& method, KernelId kernel,
                           const Rules& rules = {}) {
  const Expected<ShadowResult> result =
      compute_with(scene.prepared(), options_by(method, kernel), rules);
  if (!result) throw std::runtime_error(to_string(result.error()));
  std::vector<mpq_class> fractions;
  for (const ExactFractions& part : result->lights.at(0).exact_fractions) {
    fractions.push_back(part.lit);
  }
  return fractions;
}

using Fractions = std::vector<mpq_class>;

/// A, [1, 2]^2, above B, [0, 3]^2, and C, [1, 3] x [1, 2], of one plane: A's shadow is a ninth of B
/// and half of C, and A's cone is inside B's.
std::unique_ptr<Case> small_over_two_coplanar() {
  ScenePen pen;
  add_quad(pen, 1, 1, 2, 2, 1);
  add_quad(pen, 0, 0, 3, 3, 0);
  add_quad(pen, 1, 1, 3, 2, 0);
  return under_sun(pen);
}

TEST(SystemRules, AVolumeDiesAfterItsKillersPlaneReceived) {
  const auto scene = small_over_two_coplanar();
  ASSERT_EQ(check_methods(*scene), "");
  for (const KernelId kernel : kExactKernels) {
    for (const std::string method : {"basic", "tiling", "tiling:tiles=1"}) {
      const Fractions right = {1, mpq_class(8, 9), mpq_class(1, 2)};
      EXPECT_EQ(lit(*scene, method, kernel), right) << method;
      Rules rules;
      rules.volumes_die_after_their_plane_received = false;
      EXPECT_EQ(lit(*scene, method, kernel, rules)[2], 1) << method;
      // Without pruning nothing dies.
      EXPECT_EQ(
          lit(*scene, method + (method.ends_with('1') ? "," : ":") + "prune=off", kernel, rules),
          right)
          << method;
    }
  }
}

TEST(SystemRules, ATileClosesAfterItsClosersPlaneReceived) {
  // One tile, [0, 3]^2, which B closes.
  const auto scene = small_over_two_coplanar();
  Rules rules;
  rules.tiles_close_after_their_plane_received = false;
  for (const KernelId kernel : kExactKernels) {
    EXPECT_EQ(lit(*scene, "tiling:tiles=1", kernel, rules)[2], 1);
    // Of a boundary tile nothing is lost: A's tile is its own.
    EXPECT_EQ(lit(*scene, "tiling:tiles=3", kernel, rules)[2], mpq_class(1, 2));
  }
}

TEST(SystemRules, AClosedTilePassesToTheKiller) {
  // 3 x 3 tiles over [0, 3]^2: q closes four of them, p finds them closed and kills q.
  ScenePen pen;
  add_quad(pen, 0, 0, 2, 2, 2);
  add_quad(pen, 0, 0, 3, 3, 1);
  add_quad(pen, 0, 0, 1, 1, 0);
  const auto scene = under_sun(pen);
  ASSERT_EQ(check_methods(*scene), "");
  Rules rules;
  rules.closed_tiles_pass_to_the_killer = false;
  for (const KernelId kernel : kExactKernels) {
    const Fractions right = {1, mpq_class(5, 9), 0};
    EXPECT_EQ(lit(*scene, "tiling:tiles=3", kernel), right);
    EXPECT_EQ(lit(*scene, "tiling:tiles=3", kernel, rules)[2], 1);
    EXPECT_EQ(lit(*scene, "tiling:tiles=3,prune=off", kernel, rules), right);
  }
  // q's four writes; p closes the other five and takes over the four; the target, [0, 1]^2, is
  // inside p's volume.
  expect_counts(*scene, "tiling:tiles=3",
                {{kVolumes, 2},
                 {kDied, 1},
                 {kCovered, 1},
                 {kTests, 2},
                 {kTileWrites, 4 + 5 + 4},
                 {kClosedTiles, 9}});
}

TEST(SystemRules, EdgesStandAboveSupports) {
  // C is inserted first. With its support plane at the root, D's volume ends at C's plane, though C
  // is elsewhere, and the receiver under D is lit.
  ScenePen pen;
  add_quad(pen, 0, 0, 1, 1, 1);
  add_quad(pen, 2, 0, 3, 1, 2);
  add_quad(pen, 2, 0, 3, 1, 0);
  const auto scene = under_sun(pen);
  ASSERT_EQ(check_methods(*scene), "");
  Rules rules;
  rules.edges_above_supports = false;
  for (const KernelId kernel : kExactKernels) {
    const Fractions right = {1, 1, 0};
    EXPECT_EQ(lit(*scene, "svbsp-full:order=file", kernel), right);
    EXPECT_EQ(lit(*scene, "svbsp-full:order=file", kernel, rules)[2], 1);
  }
}

}  // namespace
}  // namespace gnomon::test
