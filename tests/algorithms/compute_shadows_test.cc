// SPDX-License-Identifier: GPL-3.0-or-later
// The entry point itself: what it refuses, what it reports while it works, which stage it says
// answered.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "fuzz/generate/families.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "solve.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

std::unique_ptr<Case> box_on_floor() {
  ScenePen pen;
  pen.polygon({{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}}).box({0, 0, 0}, {2, 2, 2});
  pen.lamp({1, 1, 6}).sun({1, 0, 1});
  return Case::make(pen.take());
}

ErrorCode code_of(const Case& scene, const ShadowOptions& options) {
  const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
  EXPECT_FALSE(result);
  return result ? ErrorCode::kFile : result.error().code;
}

TEST(ComputeShadows, RefusesWhatIsNoThickness) {
  const auto scene = box_on_floor();
  ShadowOptions options;
  options.kernel.id = KernelId::kDouble;
  for (const double thickness : {-1e-12, 1.0, std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()}) {
    options.kernel.thickness = thickness;
    EXPECT_EQ(code_of(*scene, options), ErrorCode::kUsage) << thickness;
  }
}

TEST(ComputeShadows, TakesLightsOfEveryKindAndRefusesThoseThatAreNot) {
  ScenePen pen;
  pen.polygon({{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}}).lamp({0, 0, 4});
  Scene scene = pen.take();
  Light panel;
  panel.id = "panel";
  panel.type = LightType::kArea;
  for (const Triple& p : {Triple{0, 0, 4}, Triple{0, 1, 4}, Triple{1, 1, 4}, Triple{1, 0, 4}}) {
    panel.loop.push_back(pen.position(p));
  }
  scene.lights.push_back(panel);
  const auto both = Case::make(scene);
  ASSERT_TRUE(both);
  ShadowOptions options;
  options.kernel.id = KernelId::kRational;
  options.lights = {7};
  EXPECT_EQ(code_of(*both, options), ErrorCode::kUsage);
  options.lights = {};
  const Expected<ShadowResult> result = compute_shadows(both->prepared(), options);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->lights.size(), 2u);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(result->lights[i].light, i);
    ASSERT_EQ(result->lights[i].parts.size(), 1u);
    EXPECT_EQ(result->lights[i].area_fractions.size(), i);
  }
  EXPECT_EQ(result->algorithm, "contour+receiver");
  options.lights = {1, 0};
  const Expected<ShadowResult> turned = compute_shadows(both->prepared(), options);
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->lights[0].light, 1u);
}

TEST(ComputeShadows, StopsWhenInterrupted) {
  const auto scene = box_on_floor();
  const std::atomic<bool> stop = true;
  for (const KernelInfo& kernel : kernel_list()) {
    for (const MethodId algorithm : kAlgorithms) {
      ShadowOptions options;
      options.kernel.id = kernel.id;
      options.method.point = algorithm;
      options.control.interrupted = &stop;
      EXPECT_EQ(code_of(*scene, options), ErrorCode::kInterrupted) << kernel.name;
    }
  }
}

TEST(ComputeShadows, ReportsProgressThatGrows) {
  const auto scene = box_on_floor();
  for (const MethodId algorithm : kAlgorithms) {
    ShadowOptions options;
    options.method.point = algorithm;
    options.tuning.task_size = 1;
    std::vector<double> seen;
    options.control.progress = [&](double done) { seen.push_back(done); };
    ASSERT_TRUE(compute_shadows(scene->prepared(), options));
    ASSERT_FALSE(seen.empty());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_GE(seen[i], i == 0 ? 0.0 : seen[i - 1]);
      EXPECT_LE(seen[i], 1.0);
    }
  }
}

TEST(ComputeShadows, AlgorithmIsContourForSharesElseSectorsUnlessOnlySvbspCan) {
  const auto scene = box_on_floor();
  ShadowOptions asked;
  const auto chosen = [&] { return compute_shadows(scene->prepared(), asked)->algorithm; };
  EXPECT_EQ(chosen(), "contour");
  asked.output.points = true;
  EXPECT_EQ(chosen(), "sectors");
  asked.output = {};
  asked.output.exact_fractions = true;
  EXPECT_EQ(chosen(), "sectors");
  asked.output = {};
  asked.kernel.id = KernelId::kDouble;  // rounded: no bound would tell what is wrong
  EXPECT_EQ(chosen(), "sectors");
  const auto algorithm_of = [&](MethodId algorithm, bool combined) {
    ShadowOptions options;
    options.method.point = algorithm;
    options.output.combined = combined;
    const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
    EXPECT_TRUE(result);
    return result ? result->algorithm : "";
  };
  EXPECT_EQ(algorithm_of(MethodId::kAutomatic, true), "svbsp");
  EXPECT_EQ(algorithm_of(MethodId::kSectors, false), "sectors");
  EXPECT_EQ(algorithm_of(MethodId::kSvbsp, false), "svbsp");
}

TEST(ComputeShadows, UnderAnAreaLightContourIsForSharesOfPlaneElseReceiver) {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}});
  pen.polygon({{4, 4, 2}, {6, 4, 2}, {6, 6, 2}, {4, 6, 2}});
  pen.panel({{3, 3, 8}, {3, 6, 8}, {6, 6, 8}, {6, 3, 8}});
  const auto scene = Case::make(pen.take());
  ShadowOptions asked;
  const auto chosen = [&] { return compute_shadows(scene->prepared(), asked)->algorithm; };
  EXPECT_EQ(chosen(), "contour");
  asked.kernel.id = KernelId::kRational;
  EXPECT_EQ(chosen(), "receiver");
  asked.kernel.id = KernelId::kPlane;
  asked.output.combined = true;
  EXPECT_EQ(chosen(), "receiver");
  asked.output = {};
  asked.output.exact_fractions = true;
  EXPECT_EQ(chosen(), "receiver");
  asked.output = {};
  asked.output.points = true;
  EXPECT_EQ(chosen(), "receiver");
  EXPECT_FALSE(compute_shadows(scene->prepared(), asked)->lights[0].fragments.empty());
  asked.output = {};
  asked.method.area = MethodId::kMerged;
  EXPECT_EQ(chosen(), "merged");
}

TEST(ComputeShadows, EveryKernelSaysWhatItIs) {
  const auto scene = box_on_floor();
  for (const KernelInfo& kernel : kernel_list()) {
    for (const MethodId algorithm : kAlgorithms) {
      ShadowOptions options;
      options.kernel.id = kernel.id;
      options.method.point = algorithm;
      options.output.points = true;
      const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
      ASSERT_TRUE(result) << kernel.name;
      EXPECT_EQ(result->kernel, kernel.name);
      EXPECT_EQ(result->algorithm, name_of(algorithm));
      EXPECT_EQ(result->exact, kernel.exact);
      EXPECT_EQ(result->thickness, kernel.exact ? 0 : options.kernel.thickness);
      ASSERT_EQ(result->lights.size(), 2u);
      for (const LightResult& light : result->lights) {
        ASSERT_EQ(light.parts.size(), scene->prepared().parts.size());
        EXPECT_GT(light.tree_nodes, 0u);
        std::uint64_t fragments = 0, points = 0;
        for (const PartResult& part : light.parts) {
          EXPECT_EQ(part.first_fragment, fragments);
          fragments += part.fragment_count;
          EXPECT_NEAR(part.lit.middle() + part.shadow.middle(), 1, 1e-5) << kernel.name;
        }
        for (const Fragment& fragment : light.fragments) points += fragment.count;
        EXPECT_EQ(fragments, light.fragment_total);
        EXPECT_EQ(fragments, light.fragments.size());
        EXPECT_EQ(points, light.points.size());
      }
      // The lamp sees the floor and the top; the sun also a side.
      EXPECT_EQ(result->lights[0].facing_parts, 2u) << kernel.name;
      EXPECT_EQ(result->lights[1].facing_parts, 3u) << kernel.name;
      EXPECT_EQ(result->lights[1].facing_edges, 12u) << kernel.name;
    }
  }
}

TEST(ComputeShadows, FragmentsAreCountedWithoutPoints) {
  const auto scene = box_on_floor();
  for (const MethodId algorithm : kAlgorithms) {
    ShadowOptions options;
    options.method.point = algorithm;
    const Expected<ShadowResult> without = compute_shadows(scene->prepared(), options);
    options.output.points = true;
    const Expected<ShadowResult> with = compute_shadows(scene->prepared(), options);
    ASSERT_TRUE(without && with);
    for (std::size_t i = 0; i < with->lights.size(); ++i) {
      EXPECT_EQ(without->lights[i].fragment_total, with->lights[i].fragment_total);
      EXPECT_TRUE(without->lights[i].points.empty());
      EXPECT_FALSE(with->lights[i].points.empty());
    }
  }
}

StageCounts stages_of(const std::string& family, bool count, MethodId algorithm) {
  StageCounts sum;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto scene = Case::make(family_by_name(family).make(seed));
    if (!scene) continue;
    ShadowOptions options;
    options.output.stage_counts = count;
    options.method.point = algorithm;
    const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
    if (result) sum += result->stages;
  }
  return sum;
}

class StageCount : public testing::TestWithParam<MethodId> {
 protected:
  static StageCounts counts(const std::string& family, bool count = true) {
    return stages_of(family, count, GetParam());
  }
};

TEST_P(StageCount, AreOffUnlessAskedFor) { EXPECT_EQ(counts("Lattice", false).total(), 0u); }

TEST_P(StageCount, GenericScenesAreForTheFilter) {
  const StageCounts stages = counts("Generic");
  EXPECT_GT(stages.filter, 100 * stages.exact());
}

TEST_P(StageCount, CrossingsAreKnownByIdentity) { EXPECT_GT(counts("Crossing").identity, 0u); }

TEST_P(StageCount, LatticesNeedNarrowIntegersOnly) {
  const StageCounts stages = counts("Lattice");
  EXPECT_GT(stages.exact64 + stages.exact128, 0u);
  EXPECT_GT(stages.exactly_zero, 0u);
  EXPECT_EQ(stages.exact256 + stages.exact512 + stages.exact1024 + stages.unbounded, 0u);
  EXPECT_LE(stages.exactly_zero, stages.exact());
}

TEST_P(StageCount, MixedMagnitudesNeedUnboundedIntegers) {
  EXPECT_GT(counts("MixedMagnitudes").unbounded, 0u);
}

INSTANTIATE_TEST_SUITE_P(Algorithms, StageCount, testing::ValuesIn(kAlgorithms),
                         [](const auto& info) { return name_of(info.param); });

// The grid's bits are those of the vertices: the width of the exact stage must follow the lamp.
TEST(FarLamp, ExactStageIsAsWideAsTheLampNeeds) {
  for (const int exponent : {20, 40, 50, 52, 56, 60, 70, 200}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      auto scene = generate("lattice", {{"n", 20}, {"size", 16}}, seed);
      ASSERT_TRUE(scene) << to_string(scene.error());
      const double far = std::ldexp(1.0, exponent);
      Light lamp;
      lamp.id = "far";
      lamp.position = {Number(far + 5), Number(2 * far + 5), Number(far + 7)};
      scene->lights = {lamp};
      const auto prepared = prepare(*scene);
      ASSERT_TRUE(prepared) << to_string(prepared.error());
      ShadowOptions options;
      options.output.exact_fractions = true;
      options.method.point = MethodId::kSvbsp;
      options.kernel.id = KernelId::kRational;
      const auto rational = compute_shadows(*prepared, options);
      ASSERT_TRUE(rational);
      const auto& theirs = rational->lights[0].exact_fractions;
      options.kernel.id = KernelId::kPlane;
      for (const MethodId algorithm : kAlgorithms) {
        options.method.point = algorithm;
        options.tuning.leaf_size = seed % 2 == 0 ? 2 : 16;
        const auto plane = compute_shadows(*prepared, options);
        ASSERT_TRUE(plane);
        const auto& ours = plane->lights[0].exact_fractions;
        options.output.exact_fractions = false;
        const auto enclosed = compute_shadows(*prepared, options);
        ASSERT_TRUE(enclosed);
        options.output.exact_fractions = true;
        for (std::size_t i = 0; i < ours.size(); ++i) {
          EXPECT_EQ(ours[i].lit, theirs[i].lit) << "2^" << exponent << " part " << i;
          const Interval& bounds = enclosed->lights[0].parts[i].lit;
          EXPECT_LE(mpq_class(bounds.lower), ours[i].lit) << "2^" << exponent;
          EXPECT_GE(mpq_class(bounds.upper), ours[i].lit) << "2^" << exponent;
        }
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
