// SPDX-License-Identifier: GPL-3.0-or-later
// Real scenes: buildings, city models, radiosity rooms, from the optional directory of further test
// scenes. All exact kernels equal the oracle exactly by both algorithms; where there are no such
// scenes, skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "exact_check.h"
#include "gnomon/scene/read.h"

namespace gnomon::test {
namespace {

/// The names are fixed here, so that a test program that is listed elsewhere has the same tests.
const std::vector<std::string> kScenes = {
    "apartment-midrise", "ashrae140-case610",    "ashrae140-case630", "city-denhaag",
    "city-holes",        "city-japan",           "radiance-blinds",   "radiance-cornell",
    "radiance-desk",     "radiance-draft-table", "single-family",     "spd-tetra1024",
    "spd-tetra64"};

std::filesystem::path path_of(const std::string& name) {
  return std::filesystem::path(GNOMON_SHARED_SCENES) / "json" / (name + ".json");
}

std::unique_ptr<Case> load(const std::string& name) {
  Expected<ReadResult> read = read_scene(path_of(name));
  if (!read) {
    ADD_FAILURE() << to_string(read.error());
    return nullptr;
  }
  std::string why;
  auto scene = Case::make(std::move(read->scene), &why);
  EXPECT_TRUE(scene) << why;
  return scene;
}

bool is_missing(const std::string& name) {
  return std::string(GNOMON_SHARED_SCENES).empty() || !std::filesystem::exists(path_of(name));
}

class SharedScenes : public testing::TestWithParam<std::string> {};

TEST_P(SharedScenes, KernelsAndOracleAgree) {
  if (is_missing(GetParam())) GTEST_SKIP() << "no " << path_of(GetParam());
  const auto scene = load(GetParam());
  ASSERT_TRUE(scene);
  EXPECT_EQ(check_exact(*scene), "");
}

TEST_P(SharedScenes, EveryMethodAgrees) {
  if (is_missing(GetParam())) GTEST_SKIP() << "no " << path_of(GetParam());
  const auto scene = load(GetParam());
  ASSERT_TRUE(scene);
  constexpr std::size_t kSmall = 100;
  if (scene->prepared().parts.size() * scene->prepared().lights.size() > kSmall) {
    GTEST_SKIP() << "not small";
  }
  EXPECT_EQ(check_methods(*scene), "");
}

INSTANTIATE_TEST_SUITE_P(All, SharedScenes, testing::ValuesIn(kScenes), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(SharedScenes, NoneIsForgotten) {
  if (std::string(GNOMON_SHARED_SCENES).empty()) GTEST_SKIP() << "no further scenes";
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(GNOMON_SHARED_SCENES) / "json")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_NE(std::find(kScenes.begin(), kScenes.end(), entry.path().stem().string()),
              kScenes.end())
        << entry.path();
  }
}

TEST(SharedScenes, EastWallOfCase630) {
  const std::string name = "ashrae140-case630";
  if (is_missing(name)) GTEST_SKIP() << "no " << path_of(name);
  const auto scene = load(name);
  ASSERT_TRUE(scene);
  const std::string first_sun = scene->scene().lights[0].id;
  const std::string wall = "ZONE SURFACE EAST";
  const std::uint32_t polygon = static_cast<std::uint32_t>(
      std::find_if(scene->scene().polygons.begin(), scene->scene().polygons.end(),
                   [&](const Polygon& p) { return p.id == wall; }) -
      scene->scene().polygons.begin());
  for (const oracle::AnswerEntry& entry : scene->answer().entries(0)) {
    if (entry.polygon != polygon) continue;
    EXPECT_EQ(scene->answer().fractions(0, entry).lit.exact, mpq_class(97, 147));
  }
  for (const KernelId kernel : kExactKernels) {
    for (const MethodId algorithm : kAlgorithms) {
      ShadowOptions options = options_for(kernel);
      options.method.point = algorithm;
      EXPECT_EQ(lit_fraction_of(*scene, options, first_sun, wall), mpq_class(97, 147));
    }
  }
}

}  // namespace
}  // namespace gnomon::test
