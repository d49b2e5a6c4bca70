// SPDX-License-Identifier: GPL-3.0-or-later
// The sectors algorithm on scenes large enough to make a tree and many tasks: the same result to
// the last bit whatever the number of threads, the same fractions as SVBSP, bounds that hold at
// every scale, limits and interruption; and the smallest scenes there are.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/scene/generate.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

struct Generated {
  std::string generator;
  std::map<std::string, std::int64_t> parameters;
};

PreparedScene prepared(const Generated& what, std::uint64_t seed = 1) {
  const Expected<Scene> scene = generate(what.generator, what.parameters, seed);
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  Expected<PreparedScene> result = prepare(*scene);
  if (!result) throw std::runtime_error(to_string(result.error()));
  return std::move(*result);
}

ShadowResult solved(const PreparedScene& scene, const ShadowOptions& options) {
  Expected<ShadowResult> result = compute_shadows(scene, options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  return std::move(*result);
}

ShadowOptions sectors(KernelId kernel = KernelId::kPlane) {
  ShadowOptions options;
  options.kernel.id = kernel;
  options.method.point = MethodId::kSectors;
  return options;
}

// --- Threads ---

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const Interval& a, const Interval& b) {
  return same_bits(a.lower, b.lower) && same_bits(a.upper, b.upper);
}

void expect_identical(const LightResult& a, const LightResult& b) {
  EXPECT_EQ(a.tree_nodes, b.tree_nodes);
  EXPECT_EQ(a.fragment_total, b.fragment_total);
  EXPECT_EQ(a.dropped_slivers, b.dropped_slivers);
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    const PartResult &one = a.parts[i], &two = b.parts[i];
    ASSERT_TRUE(one.part == two.part && one.side == two.side && one.reason == two.reason &&
                one.first_fragment == two.first_fragment &&
                one.fragment_count == two.fragment_count && same_bits(one.lit, two.lit) &&
                same_bits(one.shadow, two.shadow))
        << "part " << i;
  }
  ASSERT_EQ(a.exact_fractions.size(), b.exact_fractions.size());
  for (std::size_t i = 0; i < a.exact_fractions.size(); ++i) {
    ASSERT_EQ(a.exact_fractions[i].lit, b.exact_fractions[i].lit) << "part " << i;
    ASSERT_EQ(a.exact_fractions[i].shadow, b.exact_fractions[i].shadow) << "part " << i;
  }
  ASSERT_EQ(a.fragments.size(), b.fragments.size());
  for (std::size_t i = 0; i < a.fragments.size(); ++i) {
    const Fragment &one = a.fragments[i], &two = b.fragments[i];
    ASSERT_TRUE(one.state == two.state && one.caster == two.caster && one.first == two.first &&
                one.count == two.count)
        << "fragment " << i;
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) ASSERT_TRUE(same_bits(a.points[i][k], b.points[i][k]));
  }
  ASSERT_EQ(a.exact_points, b.exact_points);
}

void expect_independent_of_jobs(const PreparedScene& scene, ShadowOptions options) {
  // As many threads as are asked for, on however few cores.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  options.tuning.jobs = 1;
  const ShadowResult alone = solved(scene, options);
  ASSERT_GT(alone.lights.size(), 0u);
  for (const unsigned jobs : {2u, 3u, 7u, 0u}) {
    options.tuning.jobs = jobs;
    const ShadowResult together = solved(scene, options);
    ASSERT_EQ(alone.lights.size(), together.lights.size());
    for (std::size_t i = 0; i < alone.lights.size(); ++i) {
      SCOPED_TRACE(std::to_string(jobs) + " jobs, light " + std::to_string(i));
      expect_identical(alone.lights[i], together.lights[i]);
    }
  }
}

TEST(SectorsJobs, CityWithLampAndSun) {
  const PreparedScene scene = prepared({"city", {{"n", 300}, {"light", 2}}});
  ShadowOptions options = sectors();
  options.output.points = options.output.exact_points = options.output.exact_fractions = true;
  expect_independent_of_jobs(scene, options);
}

TEST(SectorsJobs, CityWithLampInside) {
  const PreparedScene scene = prepared({"city", {{"n", 400}, {"inside", 1}}});
  ShadowOptions options = sectors();
  options.output.points = options.output.exact_points = true;
  expect_independent_of_jobs(scene, options);
}

TEST(SectorsJobs, Quads) {
  const PreparedScene scene = prepared({"quads", {{"n", 3000}, {"light", 2}}});
  ShadowOptions options = sectors();
  options.output.points = true;
  expect_independent_of_jobs(scene, options);
}

TEST(SectorsJobs, TasksOfOnePolygon) {
  const PreparedScene scene = prepared({"crossing-sticks", {{"n", 60}, {"light", 2}}});
  ShadowOptions options = sectors();
  options.output.exact_points = options.output.exact_fractions = true;
  options.tuning.leaf_size = 2;
  options.tuning.task_size = 1;
  expect_independent_of_jobs(scene, options);
}

TEST(SectorsJobs, EveryKernel) {
  const PreparedScene scene = prepared({"city", {{"n", 100}, {"light", 2}}});
  ASSERT_GT(scene.parts.size(), 256u);
  for (const KernelInfo& kernel : kernel_list()) {
    SCOPED_TRACE(std::string(kernel.name));
    ShadowOptions options = sectors(kernel.id);
    options.output.points = true;
    for (const bool identity : {false, true}) {
      options.kernel.identity = identity;
      expect_independent_of_jobs(scene, options);
    }
  }
}

// --- The other algorithm ---

class SectorsAndSvbsp : public testing::TestWithParam<Generated> {
 protected:
  static void compare(bool exact) {
    const PreparedScene scene = prepared(GetParam());
    ShadowOptions options;
    options.output.exact_fractions = exact;
    options.method.point = MethodId::kSvbsp;
    const ShadowResult svbsp = solved(scene, options);
    options.method.point = MethodId::kSectors;
    for (const std::uint32_t leaf_size : {16u, 3u}) {
      options.tuning.leaf_size = leaf_size;
      const ShadowResult result = solved(scene, options);
      ASSERT_EQ(result.lights.size(), svbsp.lights.size());
      for (std::size_t l = 0; l < result.lights.size(); ++l) {
        std::size_t mixed = 0;
        for (std::size_t i = 0; i < scene.parts.size(); ++i) {
          const PartResult &a = result.lights[l].parts[i], &b = svbsp.lights[l].parts[i];
          ASSERT_EQ(a.reason, b.reason) << i;
          ASSERT_EQ(a.side, b.side) << i;
          ASSERT_LE(a.lit.lower, b.lit.upper) << i;
          ASSERT_LE(b.lit.lower, a.lit.upper) << i;
          ASSERT_LT(a.lit.upper - a.lit.lower, 1e-7) << i;
          if (exact) {
            const mpq_class& lit = result.lights[l].exact_fractions[i].lit;
            ASSERT_EQ(lit, svbsp.lights[l].exact_fractions[i].lit) << i;
            ASSERT_LE(mpq_class(a.lit.lower), lit) << i;
            ASSERT_GE(mpq_class(a.lit.upper), lit) << i;
          }
          mixed += a.lit.lower > 0 && a.lit.upper < 1 ? 1 : 0;
        }
        EXPECT_GT(mixed, 0u);  // borders of shadows are there at all
      }
    }
  }
};

TEST_P(SectorsAndSvbsp, HaveTheSameExactFractions) { compare(true); }

std::string name_of_generated(const testing::TestParamInfo<Generated>& info) {
  std::string name = info.param.generator;
  for (const auto& [parameter, value] : info.param.parameters) {
    name += "_" + parameter + std::to_string(value);
  }
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, SectorsAndSvbsp,
    testing::Values(Generated{"quads", {{"n", 800}, {"light", 2}}},
                    Generated{"quads", {{"n", 300}, {"two_sided", 1}, {"light", 2}}},
                    Generated{"city", {{"n", 400}, {"light", 2}}},
                    Generated{"city", {{"n", 400}, {"inside", 1}}},
                    Generated{"lattice", {{"n", 120}, {"size", 6}, {"light", 2}}},
                    Generated{"crossing-sticks", {{"n", 120}, {"light", 2}}},
                    Generated{"coplanar-tiles", {{"n", 600}, {"levels", 3}, {"light", 2}}},
                    Generated{"nested-boxes", {{"n", 60}, {"light", 2}}},
                    Generated{"touching-boxes", {{"n", 100}, {"light", 2}}},
                    Generated{"grazing", {{"n", 150}, {"light", 2}}},
                    Generated{"needles", {{"n", 150}, {"light", 2}}},
                    Generated{"comb", {{"n", 200}, {"light", 2}}},
                    Generated{"stairs", {{"n", 150}, {"light", 2}}},
                    Generated{"tetra", {{"level", 6}}}),
    name_of_generated);

class LargeSectorsAndSvbsp : public SectorsAndSvbsp {};

TEST_P(LargeSectorsAndSvbsp, HaveBoundsThatMeet) { compare(false); }

INSTANTIATE_TEST_SUITE_P(Scenes, LargeSectorsAndSvbsp,
                         testing::Values(Generated{"quads", {{"n", 6000}, {"light", 2}}},
                                         Generated{"city", {{"n", 4000}, {"light", 2}}}),
                         name_of_generated);

// --- Bounds ---

/// Bounds computed without exact fractions hold those, and are narrow.
void expect_bounds(const PreparedScene& scene, ShadowOptions options) {
  const ShadowResult bounds = solved(scene, options);
  options.output.exact_fractions = true;
  const ShadowResult exact = solved(scene, options);
  for (std::size_t l = 0; l < exact.lights.size(); ++l) {
    for (std::size_t i = 0; i < exact.lights[l].parts.size(); ++i) {
      const ExactFractions& truth = exact.lights[l].exact_fractions[i];
      const PartResult& own = bounds.lights[l].parts[i];
      ASSERT_LE(mpq_class(own.lit.lower), truth.lit);
      ASSERT_GE(mpq_class(own.lit.upper), truth.lit);
      ASSERT_LE(mpq_class(own.shadow.lower), truth.shadow);
      ASSERT_GE(mpq_class(own.shadow.upper), truth.shadow);
      ASSERT_LT(own.lit.upper - own.lit.lower, 1e-6);
    }
  }
}

class SectorBounds : public testing::TestWithParam<std::string> {};

TEST_P(SectorBounds, HoldTheExactFractionAtEveryScale) {
  for (std::uint64_t seed = 400000; seed < 400008; ++seed) {
    const Scene made = family_by_name(GetParam()).make(seed);
    for (const int exponent : {-1500, -900, -300, -75, 0, 75, 300, 900, 1500}) {
      const auto scene = Case::make(scaled(made, exponent));
      if (!scene) continue;
      for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational}) {
        ShadowOptions options = sectors(kernel);
        options.tuning.leaf_size = seed % 2 == 0 ? 1 : 16;
        expect_bounds(scene->prepared(), options);
        ASSERT_FALSE(HasFatalFailure()) << seed << " times 2^" << exponent;
      }
    }
  }
}

// Grids of some 500 bits, and cells whose corners have few: integers of one area on both sides of
// the largest double.
TEST(SectorBoundsOnWideGrids, HoldTheExactFraction) {
  for (const std::uint64_t seed : {50000370u, 50000441u, 50000562u}) {
    const auto scene = Case::make(family_by_name("MixedMagnitudes").make(seed));
    ASSERT_TRUE(scene);
    EXPECT_GT(scene->prepared().geometry.grid.bits(), 400u);
    for (const std::uint32_t leaf_size : {0u, 1u, 2u}) {
      ShadowOptions options = sectors();
      options.tuning.leaf_size = leaf_size;
      options.tuning.task_size = leaf_size + 1;
      expect_bounds(scene->prepared(), options);
      ASSERT_FALSE(testing::Test::HasFatalFailure()) << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SectorBounds,
                         testing::Values("Generic", "Lattice", "Crossing", "CrossingSticks",
                                         "CoplanarTiles", "NestedBoxes", "Grazing", "Needles"),
                         [](const auto& info) { return info.param; });

// --- Limits ---

TEST(SectorLimits, AreExact) {
  const PreparedScene scene = prepared({"quads", {{"n", 60}}});
  const PreparedScene large = prepared({"quads", {{"n", 1500}}});
  for (const PreparedScene* own : {&scene, &large}) {
    for (const unsigned jobs : {1u, 3u}) {
      ShadowOptions options = sectors();
      options.tuning.jobs = jobs;
      options.tuning.leaf_size = own == &scene ? 2 : 16;
      options.tuning.task_size = own == &scene ? 3 : 0;
      const std::uint64_t total = solved(*own, options).lights[0].fragment_total;
      ASSERT_GT(total, own->parts.size());
      options.limits.fragments = total;
      EXPECT_TRUE(compute_shadows(*own, options));
      for (const std::uint64_t limit : {std::uint64_t{0}, total / 2, total - 1}) {
        options.limits.fragments = limit;
        const Expected<ShadowResult> result = compute_shadows(*own, options);
        ASSERT_FALSE(result) << limit << " of " << total;
        EXPECT_EQ(result.error().code, ErrorCode::kLimit);
      }
    }
  }
}

TEST(SectorInterruption, FromAnotherThread) {
  const PreparedScene scene = prepared({"quads", {{"n", 20000}, {"light", 2}}});
  for (const unsigned jobs : {1u, 2u, 0u}) {
    for (const std::uint32_t task_size : {0u, 1u << 30}) {  // many tasks, or one
      ShadowOptions options = sectors();
      options.tuning.jobs = jobs;
      options.tuning.task_size = task_size;
      // On a busy machine the other thread may come when all is done.
      bool interrupted = false;
      for (int attempt = 0; attempt < 50 && !interrupted; ++attempt) {
        std::atomic<bool> stop = false;
        options.control.interrupted = &stop;
        std::thread other([&] {
          std::this_thread::sleep_for(std::chrono::milliseconds(2));
          stop = true;
        });
        const Expected<ShadowResult> result = compute_shadows(scene, options);
        other.join();
        interrupted = !result;
        if (!result) {
          EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
        }
      }
      EXPECT_TRUE(interrupted);
    }
  }
}

TEST(SectorInterruption, FromTheProgressReport) {
  const PreparedScene scene = prepared({"quads", {{"n", 3000}}});
  std::atomic<bool> stop = false;
  ShadowOptions options = sectors();
  options.control.interrupted = &stop;
  options.control.progress = [&](double) { stop = true; };
  const Expected<ShadowResult> result = compute_shadows(scene, options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
}

// --- The smallest scenes ---

TEST(SmallestScenes, NoPolygons) {
  ScenePen pen;
  pen.lamp({0, 0, 0}).sun({0, 0, 1});
  const Expected<PreparedScene> scene = prepare(pen.take());
  if (!scene) GTEST_SKIP() << to_string(scene.error());
  for (const KernelInfo& kernel : kernel_list()) {
    for (const MethodId algorithm : kAlgorithms) {
      ShadowOptions options = options_for(kernel.id);
      options.method.point = algorithm;
      const ShadowResult result = solved(*scene, options);
      ASSERT_EQ(result.lights.size(), 2u);
      EXPECT_TRUE(result.lights[0].parts.empty());
      EXPECT_EQ(result.lights[0].fragment_total, 0u);
    }
  }
}

TEST(SmallestScenes, NoLights) {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Expected<PreparedScene> scene = prepare(pen.take());
  ASSERT_TRUE(scene);
  for (const MethodId algorithm : kAlgorithms) {
    ShadowOptions options;
    options.method.point = algorithm;
    EXPECT_TRUE(solved(*scene, options).lights.empty());
  }
}

TEST(SmallestScenes, NothingFacesTheLight) {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}});
  pen.lamp({3, 0, -2}).sun({1, 0, -1});
  const Expected<PreparedScene> scene = prepare(pen.take());
  ASSERT_TRUE(scene);
  for (const KernelInfo& kernel : kernel_list()) {
    for (const MethodId algorithm : kAlgorithms) {
      ShadowOptions options = options_for(kernel.id);
      options.method.point = algorithm;
      const ShadowResult result = solved(*scene, options);
      for (const LightResult& light : result.lights) {
        EXPECT_EQ(light.facing_parts, 0u);
        EXPECT_EQ(light.parts[0].reason, ShadowReason::kFacesAway);
        EXPECT_EQ(light.parts[1].reason, ShadowReason::kLightInPlane);
        for (const PartResult& part : light.parts) {
          EXPECT_EQ(part.lit.upper, 0);
          EXPECT_EQ(part.shadow.lower, 1);
          EXPECT_EQ(part.fragment_count, 0u);
        }
      }
    }
  }
}

TEST(SmallestScenes, OneTriangle) {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}).lamp({1, 1, 5}).sun({1, 2, 3});
  const Expected<PreparedScene> scene = prepare(pen.take());
  ASSERT_TRUE(scene);
  for (const KernelInfo& kernel : kernel_list()) {
    for (const MethodId algorithm : kAlgorithms) {
      ShadowOptions options = options_for(kernel.id);
      options.method.point = algorithm;
      options.output.points = true;
      const ShadowResult result = solved(*scene, options);
      for (const LightResult& light : result.lights) {
        EXPECT_EQ(light.parts[0].lit.lower, 1);
        EXPECT_EQ(light.parts[0].shadow.upper, 0);
        ASSERT_EQ(light.fragments.size(), 1u);
        EXPECT_EQ(light.fragments[0].state, LightState::kLit);
        EXPECT_EQ(light.points.size(), 3u);
        double sum = 0;
        for (const auto& point : light.points) sum += point[0] + point[1] + point[2];
        EXPECT_EQ(sum, 8);
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
