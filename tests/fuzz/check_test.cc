// SPDX-License-Identifier: GPL-3.0-or-later
// All properties hold on exact kernels over the families of small scenes, and each property notices
// what breaks it.
#include "fuzz/check/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fuzz/generate/area_families.h"
#include "fuzz/generate/families.h"
#include "fuzz/moves/metamorphic.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/read.h"
#include "solve.h"

namespace gnomon::fuzz {
namespace {

using testing::Contains;
using testing::Not;

std::string failures_text(const CaseReport& report) {
  std::string text;
  for (const Failure& failure : report.failures) {
    text += failure.signature() + ": " + failure.text + "\n";
  }
  return text;
}

class ExactKernels : public testing::TestWithParam<Family> {};

TEST_P(ExactKernels, KeepEveryProperty) {
  CheckOptions options;
  options.subjects = exact_subjects();
  const std::uint64_t scenes = GetParam().name == "MixedMagnitudes" ? 3 : 11;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    const Scene scene = GetParam().make(9000 + seed);
    options.seed = seed;
    const CaseReport report = check_scene(scene, options);
    ASSERT_EQ(failures_text(report), "") << "seed " << seed << "\n" << test::text_of(scene);
    EXPECT_EQ(report.subjects.size(), options.subjects.size());
    EXPECT_NE(report.digest, "");
  }
}

std::string family_name(const testing::TestParamInfo<Family>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Point, ExactKernels, testing::ValuesIn(families()), family_name);
INSTANTIATE_TEST_SUITE_P(Area, ExactKernels, testing::ValuesIn(area_families()), family_name);

std::vector<std::string> signatures(const CaseReport& report) {
  std::vector<std::string> all;
  for (const Failure& failure : report.failures) all.push_back(failure.signature());
  return all;
}

/// A unit square over a large one, lit from above.
Scene table() {
  Expected<Scene> scene = generate("table-chair");
  EXPECT_TRUE(scene);
  return std::move(*scene);
}

TEST(Check, BordersGiveTheVerdictsOfMeasuring) {
  CheckOptions options;
  options.properties = {Property::kBorders};
  for (const char* name : {"float", "double+thin", "double/svbsp", "epick/sectors"}) {
    options.subjects.push_back(*parse_subject(name));
  }
  for (const Family& family : families()) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const Scene scene = family.make(400 + seed);
      // The seed chooses what is tolerated.
      options.seed = 37 * seed + 5;
      const CaseReport report = check_scene(scene, options);
      ASSERT_EQ(failures_text(report), "") << family.name << " " << seed;
    }
  }
}

TEST(Check, RoundedKernelsFailOnHardScenes) {
  CheckOptions options;
  options.subjects = {*parse_subject("float+thin"), *parse_subject("double+thin")};
  std::size_t failed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const CaseReport report = check_scene(family_by_name("Needles").make(seed), options);
    failed += report.failures.empty() ? 0 : 1;
    for (const Failure& failure : report.failures) {
      EXPECT_TRUE(failure.property == Property::kOracle || failure.property == Property::kClaims ||
                  failure.property == Property::kRefusal)
          << failure.signature();
    }
  }
  EXPECT_GE(failed, 10u);
}

TEST(Check, ClaimsOfRoundedLoopsAreJudgedOnTheirPolygon) {
  // Panels lie in a wall's plane: a vertex that rounding moved behind them is still on the wall.
  const auto read = read_scene(std::string(GNOMON_EXAMPLES) + "/hair.json");
  ASSERT_TRUE(read) << to_string(read.error());
  CheckOptions options;
  options.subjects = {*parse_subject("double"), *parse_subject("epick")};
  EXPECT_EQ(failures_text(check_scene(read->scene, options)), "");
}

TEST(Check, ASceneThatCannotBePreparedIsRefused) {
  Scene scene = table();
  scene.polygons.front().loop = {0, 1};
  scene.polygons.front().loop.push_back(static_cast<VertexId>(scene.vertices.size() - 1));
  scene.lights.front().type = LightType::kDirectional;
  scene.lights.front().position = {};
  CheckOptions options;
  options.subjects = exact_subjects();
  const CaseReport report = check_scene(scene, options);
  EXPECT_THAT(signatures(report), Contains("no-refusal:refused:prepare"));
}

TEST(Check, LimitsAreOfTheBudget) {
  CheckOptions options;
  options.subjects = {*parse_subject("plane/svbsp")};
  options.max_fragments = 3;
  EXPECT_THAT(signatures(check_scene(table(), options)), Contains("budget:fragments:plane/svbsp"));
}

TEST(Check, OnlyWantedPropertiesAreChecked) {
  CheckOptions options;
  options.subjects = {*parse_subject("float+thin")};
  options.properties = {Property::kRoundTrip};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(signatures(check_scene(family_by_name("Needles").make(seed), options)),
              std::vector<std::string>());
  }
}

class RoundedKernels : public testing::TestWithParam<Family> {};

TEST_P(RoundedKernels, DoNotSeeHowTheSceneIsWrittenDown) {
  CheckOptions options;
  for (const char* name : {"float", "double/svbsp", "double+thin/sectors/merged", "epick/svbsp",
                           "longdouble/svbsp-full", "double+identity/tiling"}) {
    options.subjects.push_back(*parse_subject(name));
  }
  options.properties = {Property::kMetamorphic, Property::kRefusal};
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Scene scene = GetParam().make(7000 + seed);
    options.seed = seed;
    ASSERT_EQ(failures_text(check_scene(scene, options)), "") << "seed " << seed << "\n"
                                                              << test::text_of(scene);
  }
}

INSTANTIATE_TEST_SUITE_P(Point, RoundedKernels, testing::ValuesIn(families()), family_name);
INSTANTIATE_TEST_SUITE_P(Area, RoundedKernels, testing::ValuesIn(area_families()), family_name);

TEST(Check, StagesAreTold) {
  CheckOptions options;
  options.subjects = {*parse_subject("plane")};
  std::vector<std::string> stages;
  options.stage = [&](std::string_view stage) { stages.emplace_back(stage); };
  check_scene(table(), options);
  EXPECT_EQ(stages, (std::vector<std::string>{"preparation", "subject plane", "oracle on plane",
                                              "claims of plane", "doubles of plane", "relation"}));
}

TEST(Relations, EachHoldsOnExactKernels) {
  const ShadowOptions sound = shadow_options(*parse_subject("plane"));
  for (std::size_t relation = 0; relation < relations().size(); ++relation) {
    for (const char* family : {"Lattice", "CoplanarTiles", "Decimals", "Repaired"}) {
      for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const Scene scene = family_by_name(family).make(seed);
        const auto prepared = prepare(scene);
        ASSERT_TRUE(prepared);
        const auto broken = check_relation(relation, scene, *prepared, sound, seed);
        ASSERT_TRUE(broken) << to_string(broken.error());
        EXPECT_FALSE(*broken) << relations()[relation].id << ": " << (*broken)->text << "\n"
                              << test::text_of(scene);
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::fuzz
