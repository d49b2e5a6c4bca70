// SPDX-License-Identifier: GPL-3.0-or-later
// What `gnomon shadows` says besides classes and shares: --counts, --centroids, --groups, --sky,
// --view-factor, by numbers worked out by hand; and what does not go together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kTwoShades = R"({"format": "gnomon-scene", "version": 1, "name": "shades",
 "extra": {"groups": {"glass": ["low", "high"], "all": ["ground", "low", "high"]}},
 "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0], [0,0,1],[2,0,1],[2,4,1],[0,4,1],
              [1,0,2],[3,0,2],[3,4,2],[1,4,2]],
 "polygons": [{"id": "ground", "loop": [0,1,2,3]},
              {"id": "low", "loop": [4,5,6,7]},
              {"id": "high", "loop": [8,9,10,11]}],
 "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]}]})";

/// An L: the lower left quarter of it under a roof.
const std::string kCorner = R"({"format": "gnomon-scene", "version": 1, "name": "corner",
 "vertices": [[0,0,0],[4,0,0],[4,2,0],[2,2,0],[2,4,0],[0,4,0], [0,0,1],[2,0,1],[2,2,1],[0,2,1]],
 "polygons": [{"id": "floor", "loop": [0,1,2,3,4,5]}, {"id": "roof", "loop": [6,7,8,9]}],
 "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]}]})";

/// Two triangles that are not in one plane, and a shade over nothing.
const std::string kBent = R"({"format": "gnomon-scene", "version": 1, "name": "bent",
 "vertices": [[0,0,0],[3,0,0],[3,3,3],[0,3,0]],
 "polygons": [{"id": "roof", "loop": [0,1,2,3]}],
 "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]}]})";

const std::string kObj = R"(v 0 0 0
v 4 0 0
v 4 4 0
v 0 4 0
v 0 0 1
v 2 0 1
v 2 2 1
v 0 2 1
o house
g ground
f 1 2 3 4
g roof "north part"
f 5 6 7 8
)";

/// Floor and ceiling of a unit cube.
const std::string kCube = R"({"format": "gnomon-scene", "version": 1, "name": "cube",
 "vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0], [0,0,1],[1,0,1],[1,1,1],[0,1,1]],
 "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "ceiling", "loop": [7,6,5,4]}]})";

RunResult shadows(const std::string& scene, std::vector<std::string> arguments) {
  RunOptions options;
  options.input = scene;
  arguments.insert(arguments.begin(), {"shadows", "-"});
  return run_gnomon(arguments, options);
}

rapidjson::Document result(const std::string& scene, const std::vector<std::string>& arguments) {
  const RunResult run = shadows(scene, arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(run.out.c_str());
  EXPECT_FALSE(document.HasParseError()) << run.out.substr(0, 400);
  return document;
}

const rapidjson::Value& side(const rapidjson::Document& document, unsigned index) {
  return document["lights"][0]["polygons"][index];
}

TEST(Counts, ExactSharesOfEachNumber) {
  for (const std::string kernel : {"plane", "rational", "epeck"}) {
    const auto found = result(kTwoShades, {"--counts", "--exact-fractions", "--kernel", kernel});
    const auto& counts = side(found, 0)["counts"];
    ASSERT_EQ(counts.Size(), 3U);
    const std::vector<std::string> shares{"1/4", "1/2", "1/4"};
    const std::vector<double> areas{4, 8, 4};
    for (unsigned i = 0; i < 3; ++i) {
      EXPECT_EQ(counts[i]["count"].GetUint(), i);
      EXPECT_EQ(counts[i]["fraction"].GetString(), shares[i]);
      EXPECT_EQ(counts[i]["area"].GetDouble(), areas[i]);
    }
    EXPECT_STREQ(side(found, 0)["lit"]["fraction"].GetString(), "1/4");
  }
}

TEST(Counts, NumbersWithoutExactFractions) {
  for (const std::string kernel : {"plane", "double"}) {
    const auto found = result(kTwoShades, {"--counts", "--kernel", kernel});
    EXPECT_DOUBLE_EQ(side(found, 0)["counts"][1]["fraction"].GetDouble(), 0.5);
    EXPECT_EQ(side(found, 2)["counts"][0]["fraction"].GetDouble(), 1);
  }
}

TEST(Counts, PartsAreSummed) {
  const auto found = result(kCorner, {"--counts", "--exact-fractions"});
  EXPECT_STREQ(side(found, 0)["counts"][0]["fraction"].GetString(), "2/3");
  EXPECT_STREQ(side(found, 0)["counts"][1]["fraction"].GetString(), "1/3");
}

TEST(Counts, WhatFacesAwayHasNone) {
  const auto found = result(kTwoShades, {"--counts", "--sun=0,0,-1", "--light", "sun0"});
  EXPECT_EQ(side(found, 0)["counts"].Size(), 0U);
}

TEST(Counts, AreaLightsAreRefused) {
  const RunResult run = shadows(kTwoShades, {"--counts", "--area=0,0,5:0,1,5:1,1,5:1,0,5"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("--counts"), HasSubstr("area0"), HasSubstr("--light")));
}

TEST(Centroids, OfTheLitPart) {
  // Lit are two squares around (3, 1) and (1, 3).
  const auto found = result(kCorner, {"--centroids", "--exact-fractions"});
  EXPECT_STREQ(side(found, 0)["exact_lit_centroid"][0].GetString(), "2");
  EXPECT_STREQ(side(found, 0)["exact_lit_centroid"][1].GetString(), "2");
  EXPECT_EQ(side(found, 0)["lit_centroid"][2].GetDouble(), 0);
  EXPECT_EQ(side(found, 1)["lit_centroid"][0].GetDouble(), 1);
  EXPECT_FALSE(side(found, 0).HasMember("fragments"));
}

TEST(Centroids, OfABentPolygon) {
  // Triangles of area 9/2 and 9/2 sqrt 2, or sqrt(2) and 1 the other way round, in planes that
  // meet.
  const auto found = result(kBent, {"--centroids"});
  const auto& centroid = side(found, 0)["lit_centroid"];
  EXPECT_FALSE(side(found, 0).HasMember("exact_lit_centroid"));
  for (unsigned k = 0; k < 3; ++k) {
    EXPECT_GT(centroid[k].GetDouble(), 0.5);
    EXPECT_LT(centroid[k].GetDouble(), 2.5);
  }
}

TEST(Centroids, RoundedKernelsAndDarkSides) {
  const auto found = result(kCorner, {"--centroids", "--kernel", "double"});
  EXPECT_NEAR(side(found, 0)["lit_centroid"][0].GetDouble(), 2, 1e-9);
  const auto dark = result(kCorner, {"--centroids", "--sun=0,0,-1", "--light", "sun0"});
  EXPECT_FALSE(side(dark, 0).HasMember("lit_centroid"));
}

TEST(Centroids, NeedFragmentsThatTile) {
  for (const std::string method : {"contour", "tiling:cover=overlay"}) {
    const RunResult run = shadows(kCorner, {"--centroids", "--algorithm", method});
    EXPECT_EQ(run.status, 2) << method;
    EXPECT_THAT(run.err, HasSubstr("--centroids")) << method;
  }
}

TEST(Groups, SumsOfExtra) {
  const auto found = result(kTwoShades, {"--groups", "--exact-fractions"});
  const auto& groups = found["lights"][0]["groups"];
  ASSERT_EQ(groups.Size(), 2U);
  EXPECT_STREQ(groups[0]["id"].GetString(), "glass");
  // Two panes of area 8, the lower one half under the other.
  EXPECT_EQ(groups[0]["area"].GetDouble(), 16);
  EXPECT_STREQ(groups[0]["lit"]["fraction"].GetString(), "3/4");
  EXPECT_EQ(groups[0]["lit"]["area"].GetDouble(), 12);
  EXPECT_STREQ(groups[1]["lit"]["fraction"].GetString(), "1/2");
  EXPECT_STREQ(groups[1]["shadow"]["fraction"].GetString(), "1/2");
  EXPECT_EQ(groups[1]["sides"].GetUint(), 3U);
  const auto rounded = result(kTwoShades, {"--groups"});
  EXPECT_DOUBLE_EQ(rounded["lights"][0]["groups"][0]["lit"]["fraction"].GetDouble(), 0.75);
}

TEST(Groups, OfAnObjFile) {
  const TestDirectory directory;
  const std::string file = directory.file("groups.obj");
  write_text(file, kObj);
  const RunResult run = run_gnomon({"shadows", file, "--sun=0,0,1", "--groups"});
  ASSERT_EQ(run.status, 0) << run.err;
  rapidjson::Document found;
  found.Parse(run.out.c_str());
  const auto& groups = found["lights"][0]["groups"];
  std::vector<std::string> names;
  for (const auto& group : groups.GetArray()) names.emplace_back(group["id"].GetString());
  EXPECT_THAT(names, testing::ElementsAre("house", "ground", "roof", "\"north", "part\""));
  EXPECT_EQ(groups[0]["area"].GetDouble(), 20);
  EXPECT_EQ(groups[0]["lit"]["area"].GetDouble(), 16);
  EXPECT_EQ(groups[1]["lit"]["area"].GetDouble(), 12);
  // They come along when the file is converted.
  const RunResult converted = run_gnomon({"convert", file, "-", "--format", "json"});
  EXPECT_THAT(converted.out,
              HasSubstr(R"("house":["house/ground/0","house/roof/\"north/part\"/0"])"));
}

TEST(Groups, ErrorsNameThePlace) {
  RunResult run = shadows(kCorner, {"--groups"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("names no groups"), HasSubstr("extra")));
  std::string wrong = kTwoShades;
  wrong.replace(wrong.find("\"high\"]"), 7, "\"nobody\"]");
  run = shadows(wrong, {"--groups"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("nobody"), HasSubstr("/extra/groups/glass/1")));
}

TEST(Factors, ViewFactorAndSky) {
  // Parallel unit squares at distance 1: 0.19982489569838746...
  const auto found = result(kCube, {"--view-factor", "floor", "ceiling", "--sky"});
  EXPECT_EQ(found["lights"].Size(), 0U);
  const auto& factor = found["view_factors"][0];
  EXPECT_STREQ(factor["from"].GetString(), "floor");
  EXPECT_STREQ(factor["to"].GetString(), "ceiling");
  EXPECT_NEAR(factor["factor"].GetDouble(), 0.19982489569838746, 1e-12);
  EXPECT_LE(factor["enclosure"][0].GetDouble(), 0.19982489569838746);
  EXPECT_GE(factor["enclosure"][1].GetDouble(), 0.19982489569838746);
  // One-sided, the ceiling does not stop what comes from above: it casts with its lower side.
  ASSERT_EQ(found["sky"].Size(), 2U);
  EXPECT_NEAR(found["sky"][0]["factor"].GetDouble(), 1, 1e-9);
  EXPECT_EQ(found["sky"][1]["factor"].GetDouble(), 0);
}

TEST(Factors, WrongCombinations) {
  RunResult run = shadows(kCube, {"--view-factor", "floor", "attic"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("attic"));
  run = shadows(kCube, {"--sky", "--up", "1,2"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--up"));
  run = shadows(kCube, {"--up", "0,1,0"});
  EXPECT_EQ(run.status, 2);
  run = shadows(kCube, {"--counts"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("there is no light"));
  const TestDirectory directory;
  run = shadows(kTwoShades, {"--sky", "--shares", directory.file("shares.csv")});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--sky is of the result"));
}

}  // namespace
}  // namespace gnomon::test
