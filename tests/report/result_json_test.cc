// SPDX-License-Identifier: GPL-3.0-or-later
// From parts back to polygons: sums over coplanar parts are exact, others are enclosed.
#include "gnomon/report/result_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <limits>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/report/candidate_from_result.h"
#include "gnomon/report/polygon_sides.h"
#include "gnomon/scene/read.h"

namespace gnomon::report {
namespace {

struct Classified {
  Scene scene;
  PreparedScene prepared;
  ShadowResult result;
};

Classified classify(const std::string& text, KernelId kernel = KernelId::kPlane) {
  Classified all;
  auto read = parse_scene(text, "test.json");
  EXPECT_TRUE(read) << to_string(read.error());
  all.scene = std::move(read->scene);
  auto prepared = prepare(all.scene);
  EXPECT_TRUE(prepared) << to_string(prepared.error());
  all.prepared = std::move(*prepared);
  ShadowOptions options;
  options.kernel = kernel;
  options.keep_points = true;
  options.exact_fractions = true;
  auto result = compute_shadows(all.prepared, options);
  EXPECT_TRUE(result);
  all.result = std::move(*result);
  return all;
}

/// A floor with a notch (two convex parts), half under a roof; and a square bent along its
/// diagonal.
constexpr const char* kScene = R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[4,0,0],[4,2,0],[2,2,0],[2,4,0],[0,4,0], [0,0,1],[2,0,1],[2,4,1],[0,4,1],
              [9,0,0],[10,0,0],[10,1,1],[9,1,0], [7,7,0],[8,7,0],[9,7,0]],
 "polygons": [{"id": "floor", "loop": [0,1,2,3,4,5]}, {"id": "roof", "loop": [6,7,8,9]},
              {"id": "bent", "loop": [10,11,12,13]}, {"id": "line", "loop": [14,15,16]}],
 "lights": [{"id": "zenith", "type": "directional", "to_light": [0,0,1]}]})";

TEST(PolygonSides, CoplanarPartsAddUpExactly) {
  const Classified all = classify(kScene);
  ASSERT_GT(all.prepared.first_part[1], 1u);
  const auto sides = polygon_sides(all.prepared, all.result.lights[0], 0, true);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_TRUE(sides[0].coplanar);
  EXPECT_EQ(*sides[0].exact_lit, mpq_class(1, 3));
  EXPECT_EQ(*sides[0].exact_shadow, mpq_class(2, 3));
  EXPECT_EQ(sides[0].area, 12);
}

TEST(PolygonSides, PartsInSeveralPlanesAreEnclosed) {
  const Classified all = classify(kScene);
  const auto sides = polygon_sides(all.prepared, all.result.lights[0], 2, true);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_FALSE(sides[0].coplanar);
  EXPECT_EQ(sides[0].parts.size(), 2u);
  EXPECT_FALSE(sides[0].exact_lit);
  EXPECT_LE(sides[0].lit.lower, 1);
  EXPECT_GE(sides[0].lit.upper, 1);
}

TEST(ResultJson, IsWellFormedAndListsEverything) {
  const Classified all = classify(kScene);
  ResultJsonOptions options;
  options.fragments = true;
  options.exact_fractions = true;
  StringSink sink;
  write_result_json(sink, all.scene, all.prepared, all.result, options);
  rapidjson::Document json;
  json.Parse(sink.text().c_str());
  ASSERT_FALSE(json.HasParseError());
  const auto& polygons = json["lights"][0]["polygons"];
  ASSERT_EQ(polygons.Size(), 3u);
  EXPECT_STREQ(polygons[0]["lit"]["fraction"].GetString(), "1/3");
  EXPECT_EQ(polygons[0]["lit"]["area"].GetDouble(), 4);
  EXPECT_EQ(polygons[2]["parts"].Size(), 2u);
  EXPECT_TRUE(polygons[2]["lit"].HasMember("enclosure"));
  ASSERT_EQ(json["dropped"].Size(), 1u);
  EXPECT_STREQ(json["dropped"][0]["id"].GetString(), "line");
}

TEST(ResultJson, WhatIsNoNumberIsNullAndAFinding) {
  Classified all = classify(kScene, KernelId::kDouble);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  all.result.lights[0].parts[all.prepared.first_part[1]].lit = {nan, nan};
  StringSink sink;
  write_result_json(sink, all.scene, all.prepared, all.result, {});
  rapidjson::Document json;
  json.Parse(sink.text().c_str());
  ASSERT_FALSE(json.HasParseError());
  EXPECT_TRUE(json["lights"][0]["polygons"][1]["lit"]["fraction"].IsNull());
  EXPECT_EQ(json["findings"].Size(), 1u);
}

TEST(CandidateFromResult, LeavesOutWhatHasNoCoordinates) {
  Classified all = classify(kScene, KernelId::kDouble);
  const auto count = [](const oracle::Candidate& candidate) {
    std::size_t fragments = 0;
    for (const auto& polygon : candidate.lights[0].polygons) fragments += polygon.fragments.size();
    return fragments;
  };
  const std::size_t before =
      count(candidate_from_result(all.scene, all.prepared, all.result, "double", false));
  all.result.lights[0].points[0][1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(count(candidate_from_result(all.scene, all.prepared, all.result, "double", false)),
            before - 1);
}

}  // namespace
}  // namespace gnomon::report
