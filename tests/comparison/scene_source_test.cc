// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/scene_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gnomon/scene/write.h"

namespace gnomon::comparison {
namespace {

using testing::HasSubstr;

std::size_t polygons(const std::string& text, std::optional<std::uint64_t> size) {
  const auto source = SceneSource::parse(text);
  if (!source) return 0;
  const auto scene = source->make(size, 1);
  return scene ? scene->polygons.size() : 0;
}

TEST(SceneSource, ASizeIsInPolygonsWhateverTheParameterCounts) {
  EXPECT_EQ(polygons("quads", 1000), 1000u);
  EXPECT_EQ(polygons("city", 1000), 996u);   // 5 a house, and the ground
  EXPECT_EQ(polygons("tetra", 1000), 258u);  // 4^4 + 2; the next has 1026
  EXPECT_EQ(polygons("tetra", 1026), 1026u);
  EXPECT_EQ(polygons("terrain", 100), 100u);  // a square
  EXPECT_EQ(polygons("stairs", 7), 6u);
  EXPECT_EQ(polygons("slater-room", 200), 200u);
}

TEST(SceneSource, TheSmallestWhereAllAreLarger) { EXPECT_EQ(polygons("city", 2), 6u); }

TEST(SceneSource, TheLargestWhereAFamilyGrowsNoMore) {
  // 4 x 4 x 4 cells hold no more boxes.
  const std::size_t most = polygons("touching-boxes", 100'000);
  EXPECT_GT(most, 50u);
  EXPECT_LT(most, 400u);
}

TEST(SceneSource, ParametersAreInTheText) {
  EXPECT_EQ(polygons("city:n=3", {}), 16u);
  EXPECT_EQ(polygons("city:n=3", 1000), 16u);
  EXPECT_EQ(polygons("tetra:ground=1", 70), 65u);
  const auto source = SceneSource::parse("city:light=2");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->make(50, 1)->lights.size(), 2u);
  EXPECT_EQ(source->name(), "city:light=2");
}

TEST(SceneSource, KnowsWhatTakesASize) {
  EXPECT_TRUE(SceneSource::parse("pinwheel")->takes_size());
  EXPECT_TRUE(SceneSource::parse("lattice")->takes_size());
  EXPECT_FALSE(SceneSource::parse("room")->takes_size());
  EXPECT_FALSE(SceneSource::parse("city:n=3")->takes_size());
  EXPECT_FALSE(SceneSource::parse("spiral")->takes_size());  // two polygons always
  EXPECT_FALSE(SceneSource::parse("soup-lattice")->takes_size());
}

TEST(SceneSource, CampaignsAndFilesAreScenesToo) {
  const auto soup = SceneSource::parse("soup-lattice+duplicate");
  ASSERT_TRUE(soup);
  const auto one = soup->make({}, 7), again = soup->make({}, 7);
  ASSERT_TRUE(one && again);
  EXPECT_EQ(scene_to_text(*one, SceneFormat::kJson)->text,
            scene_to_text(*again, SceneFormat::kJson)->text);
  EXPECT_EQ(polygons(GNOMON_EXAMPLES "/courtyard.json", {}), 44u);
}

TEST(SceneSource, WhatIsNoSceneIsRefused) {
  for (const char* text : {"castle", "city:n", "city:n=", "city:=3", "city:n=3,n=4", "city:n=x"}) {
    const auto source = SceneSource::parse(text);
    ASSERT_FALSE(source) << text;
    EXPECT_EQ(source.error().code, ErrorCode::kUsage);
    EXPECT_THAT(source.error().what, HasSubstr(text));
  }
  // The generator itself knows its parameters.
  EXPECT_FALSE(SceneSource::parse("city:houses=3")->make({}, 1));
}

}  // namespace
}  // namespace gnomon::comparison
