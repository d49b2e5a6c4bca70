// SPDX-License-Identifier: GPL-3.0-or-later
// From parts back to polygons: sums over coplanar parts are exact, others are enclosed.
#include "report/json/result_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/result/read_claims.h"
#include "gnomon/scene/read.h"
#include "kernel/signs/nearest_double.h"
#include "report/facts/facing.h"
#include "report/json/told_share.h"
#include "report/sides/claims_of.h"
#include "report/sides/part_area.h"
#include "report/sides/polygon_sides.h"

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
  options.kernel.id = kernel;
  options.output.points = true;
  options.output.exact_fractions = true;
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

/// The same under a panel, and a two-sided fin that reaches behind its plane.
constexpr const char* kAreaScene = R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[4,0,0],[4,2,0],[2,2,0],[2,4,0],[0,4,0], [0,0,1],[2,0,1],[2,4,1],[0,4,1],
              [9,0,0],[10,0,0],[10,1,1],[9,1,0], [1,6,0],[2,6,0],[2,6,9],[1,6,9],
              [0,0,20],[1,0,20],[0,1,20]],
 "polygons": [{"id": "floor", "loop": [0,1,2,3,4,5]}, {"id": "roof", "loop": [6,7,8,9]},
              {"id": "bent", "loop": [10,11,12,13]},
              {"id": "fin", "loop": [14,15,16,17], "two_sided": true},
              {"id": "above", "loop": [18,19,20]}],
 "lights": [{"id": "panel", "type": "area", "loop": [[0,5,6],[0,7,6],[3,7,6],[3,5,6]]},
            {"id": "zenith", "type": "directional", "to_light": [0,0,1]}]})";

TEST(PolygonSides, CoplanarPartsAddUpExactly) {
  const Classified all = classify(kScene);
  ASSERT_GT(all.prepared.first_part[1], 1u);
  const auto sides = polygon_sides(all.prepared, all.result.lights[0], 0, true);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_TRUE(sides[0].coplanar);
  EXPECT_EQ(*sides[0].exact_lit, mpq_class(1, 3));
  EXPECT_EQ(*sides[0].exact_shadow, mpq_class(2, 3));
  EXPECT_EQ(PolygonAreas(all.prepared).nearest(0), 12);
}

/// A square bent along its diagonal, another under a lid, and one half of whose first part is.
constexpr const char* kBentScene = R"({"format": "gnomon-scene", "version": 1, "numbers": "decimal",
 "vertices": [[0,0,0],[5,0,0.3],[5,4,0],[0,4,0.1], [20,0,0],[25,0,0.3],[25,4,0],[20,4,0.1],
              [19,-1,2],[26,-1,2],[26,5,2],[19,5,2], [40,0,0],[45,0,0.3],[45,4,0],[40,4,0.1],
              [40,-1,2],[42.5,-1,2],[42.5,2,2],[40,2,2]],
 "polygons": [{"id": "bent", "loop": [0,1,2,3]}, {"id": "dark", "loop": [4,5,6,7]},
              {"id": "lid", "loop": [8,9,10,11]}, {"id": "mixed", "loop": [12,13,14,15]},
              {"id": "small", "loop": [16,17,18,19]}],
 "lights": [{"id": "zenith", "type": "directional", "to_light": [0,0,1]}]})";

TEST(PolygonSides, PartsInSeveralPlanesAreEnclosed) {
  const Classified all = classify(kBentScene);
  const auto sides = polygon_sides(all.prepared, all.result.lights[0], 3, true);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_FALSE(sides[0].coplanar);
  ASSERT_EQ(sides[0].parts.size(), 2u);
  EXPECT_FALSE(sides[0].exact_lit);
  EXPECT_LT(sides[0].lit.upper - sides[0].lit.lower, 4e-15);
  const mpq_class lit = precise_share(all.prepared, sides[0], LightState::kLit);
  EXPECT_LE(mpq_class(sides[0].lit.lower), lit);
  EXPECT_GE(mpq_class(sides[0].lit.upper), lit);
  EXPECT_NEAR(lit.get_d(), 1 - sides[0].shadow.middle(), 1e-15);
}

TEST(PolygonSides, WhatAllPartsAreThePolygonIsInWhateverPlanesTheyLie) {
  const Classified all = classify(kBentScene);
  for (const auto& [polygon, lit] : {std::pair{0u, 1}, {1u, 0}}) {
    for (const bool exact : {true, false}) {
      const auto sides = polygon_sides(all.prepared, all.result.lights[0], polygon, exact);
      ASSERT_EQ(sides.size(), 1u);
      EXPECT_FALSE(sides[0].coplanar);
      EXPECT_EQ(sides[0].lit.lower, lit);
      EXPECT_EQ(sides[0].lit.upper, lit);
      EXPECT_EQ(sides[0].shadow.lower, 1 - lit);
      EXPECT_EQ(sides[0].shadow.upper, 1 - lit);
      EXPECT_EQ(sides[0].exact_lit.has_value(), exact);
      EXPECT_EQ(sides[0].exact_lit.value_or(lit), lit);
    }
  }
}

TEST(ResultJson, NumbersOfABentPolygon) {
  const Classified all = classify(kBentScene);
  for (const bool exact : {true, false}) {
    ResultJsonOptions options;
    options.exact_fractions = exact;
    StringSink sink;
    write_result_json(sink, all.scene, all.prepared, all.result, options);
    rapidjson::Document json;
    json.Parse<rapidjson::kParseFullPrecisionFlag>(sink.text().c_str());
    ASSERT_FALSE(json.HasParseError());
    const auto& polygons = json["lights"][0]["polygons"];
    EXPECT_EQ(polygons[0]["lit"]["area"].GetDouble(), polygons[0]["area"].GetDouble());
    EXPECT_EQ(polygons[0]["shadow"]["area"].GetDouble(), 0);
    EXPECT_EQ(polygons[1]["shadow"]["area"].GetDouble(), polygons[1]["area"].GetDouble());
    EXPECT_FALSE(polygons[0]["lit"].HasMember("enclosure"));
    EXPECT_EQ(polygons[3]["lit"].HasMember("enclosure"), exact);
    if (!exact) {
      EXPECT_EQ(polygons[0]["lit"]["fraction"].GetDouble(), 1);
      continue;
    }
    EXPECT_STREQ(polygons[0]["lit"]["fraction"].GetString(), "1");
    EXPECT_STREQ(polygons[1]["lit"]["fraction"].GetString(), "0");
    const auto side = polygon_sides(all.prepared, all.result.lights[0], 3, true).front();
    const mpq_class lit = precise_share(all.prepared, side, LightState::kLit);
    EXPECT_EQ(polygons[3]["lit"]["fraction"].GetDouble(), nearest_double(lit));
    EXPECT_EQ(polygons[3]["lit"]["area"].GetDouble(),
              nearest_double(lit * precise_area(all.prepared, 3u)));
    EXPECT_LT(polygons[3]["lit"]["enclosure"][0].GetDouble(), lit.get_d() + 1e-30);
    EXPECT_GT(polygons[3]["lit"]["enclosure"][1].GetDouble(), lit.get_d());
  }
}

TEST(ResultJson, PartsTellBoundsThatAreApart) {
  Classified all = classify(kBentScene);
  const std::uint32_t bent = all.prepared.first_part[3];
  const auto part = std::ranges::find(all.result.lights[0].parts, bent, &PartResult::part);
  ASSERT_NE(part, all.result.lights[0].parts.end());
  const double lit = part->lit.middle();
  part->lit = {lit - 1e-9, lit + 1e-9};
  StringSink sink;
  write_result_json(sink, all.scene, all.prepared, all.result, {});
  rapidjson::Document json;
  json.Parse<rapidjson::kParseFullPrecisionFlag>(sink.text().c_str());
  ASSERT_FALSE(json.HasParseError());
  const auto& parts = json["lights"][0]["polygons"][3]["parts"];
  ASSERT_TRUE(parts[0].HasMember("enclosures"));
  EXPECT_EQ(parts[0]["enclosures"]["lit"][0].GetDouble(), lit - 1e-9);
  EXPECT_EQ(parts[0]["enclosures"]["lit"][1].GetDouble(), lit + 1e-9);
  EXPECT_FALSE(parts[1].HasMember("enclosures"));
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
  EXPECT_STREQ(polygons[2]["lit"]["fraction"].GetString(), "1");
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

TEST(ResultJson, SaysHowFragmentsCoverAPolygon) {
  Classified all = classify(kScene);
  rapidjson::Document json;
  const auto written = [&] {
    StringSink sink;
    write_result_json(sink, all.scene, all.prepared, all.result, {});
    json.Parse(sink.text().c_str());
    return &json["lights"][0];
  };
  EXPECT_FALSE(written()->HasMember("cover"));
  EXPECT_FALSE(written()->HasMember("background"));
  all.result.lights[0].cover = Cover::kOverlay;
  all.result.lights[0].background = LightState::kShadow;
  EXPECT_STREQ((*written())["cover"].GetString(), "overlay");
  EXPECT_STREQ((*written())["background"].GetString(), "shadow");
}

/// Shadows on shadows: on the floor one loop and one on it, on the square one loop.
TEST(ResultJson, ListsWhatIsPaintedOnEverySide) {
  Classified all = classify(kAreaScene);
  all.result.overlay_points = {{0, 0, 0}, {2, 0, 0},  {2, 2, 0}, {1, 0, 0},
                               {9, 0, 0}, {10, 0, 0}, {9, 1, 0}};
  all.result.overlay = {
      {.part = all.prepared.first_part[0], .level = 1, .dark_for = 2, .first = 0, .count = 3},
      {.part = all.prepared.first_part[2], .level = 1, .dark_for = 2, .first = 4, .count = 3},
      {.part = all.prepared.first_part[2],
       .level = 2,
       .dark_for = 3,
       .on = 1,
       .first = 1,
       .count = 3}};
  ResultJsonOptions options;
  options.overlay = true;
  StringSink sink;
  write_result_json(sink, all.scene, all.prepared, all.result, options);
  rapidjson::Document json;
  json.Parse(sink.text().c_str());
  ASSERT_FALSE(json.HasParseError());
  const auto& overlay = json["overlay"];
  ASSERT_EQ(overlay.Size(), 2u);
  EXPECT_STREQ(overlay[0]["id"].GetString(), "floor");
  EXPECT_STREQ(overlay[0]["side"].GetString(), "front");
  ASSERT_EQ(overlay[0]["painted"].Size(), 1u);
  EXPECT_EQ(overlay[0]["painted"][0]["on"].GetInt(), -1);
  const auto& painted = overlay[1]["painted"];
  ASSERT_EQ(painted.Size(), 2u);
  EXPECT_EQ(painted[1]["level"].GetInt(), 2);
  EXPECT_EQ(painted[1]["on"].GetInt(), 0);
  ASSERT_EQ(painted[1]["dark_for"].Size(), 2u);
  EXPECT_STREQ(painted[1]["dark_for"][0].GetString(), "panel");
  EXPECT_EQ(painted[1]["loop"].Size(), 3u);
  EXPECT_EQ(painted[0]["loop"][1][0].GetDouble(), 10);
}

/// What the writer leaves out, it says.
TEST(ResultJson, SaysWhatIsNotListed) {
  const Classified all = classify(kAreaScene);
  const auto terms = [&](LightState only) {
    ResultJsonOptions options;
    options.fragments = true;
    options.only = only;
    StringSink sink;
    write_result_json(sink, all.scene, all.prepared, all.result, options);
    const auto claims = parse_claims(sink.text(), "r.json", all.scene);
    EXPECT_TRUE(claims) << to_string(claims.error());
    return *claims;
  };
  using enum LightState;
  Claims claims = terms(kShadow);
  EXPECT_EQ(claims.lights[0].background, kLit);
  EXPECT_EQ(claims.lights[1].background, kLit);
  claims = terms(kLit);
  EXPECT_EQ(claims.lights[0].listed, std::vector{kLit});
  EXPECT_EQ(claims.lights[1].background, kShadow);
  claims = terms(kUmbra);
  EXPECT_EQ(claims.lights[0].listed, std::vector{kUmbra});
  EXPECT_TRUE(claims.lights[1].listed && claims.lights[1].listed->empty());
}

TEST(CandidateFromResult, HasWhatIsToldOfSeveralLights) {
  Classified all = classify(kAreaScene);
  EXPECT_FALSE(claims_of(all.scene, all.prepared, all.result, "plane", false).combined);
  all.result.combined_points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}};
  all.result.overlay_points = all.result.combined_points;
  all.result.combined = {
      {.part = all.prepared.first_part[2], .lit_by = 2, .penumbra_of = 1, .first = 0, .count = 3}};
  const std::uint32_t floor = all.prepared.first_part[0], bent = all.prepared.first_part[2];
  all.result.overlay = {{.part = floor, .level = 1, .dark_for = 2, .first = 0, .count = 3},
                        {.part = bent, .level = 1, .dark_for = 2, .first = 0, .count = 3},
                        {.part = bent, .level = 2, .dark_for = 2, .on = 1, .first = 0, .count = 3}};
  const Claims claims = claims_of(all.scene, all.prepared, all.result, "plane", false);
  const SharedPolygon& combined = claims.combined->at(0);
  EXPECT_EQ(combined.id, "bent");
  EXPECT_EQ(combined.fragments.at(0).lit_by, std::vector<std::string>{"zenith"});
  EXPECT_EQ(combined.fragments[0].penumbra_of, std::vector<std::string>{"panel"});
  EXPECT_EQ(combined.fragments[0].loop.at(2), (RationalPoint{2, 2, 0}));
  ASSERT_EQ(claims.overlay->size(), 2u);
  EXPECT_FALSE(claims.overlay->at(1).fragments.at(0).on);
  EXPECT_EQ(claims.overlay->at(1).fragments.at(1).on, 0u);
  EXPECT_EQ(claims.overlay->at(1).fragments[1].level, 2u);
}

TEST(CandidateFromResult, LeavesOutWhatHasNoCoordinates) {
  Classified all = classify(kScene, KernelId::kDouble);
  const auto count = [](const Claims& candidate) {
    std::size_t fragments = 0;
    for (const auto& polygon : candidate.lights[0].polygons) fragments += polygon.fragments.size();
    return fragments;
  };
  const std::size_t before = count(claims_of(all.scene, all.prepared, all.result, "double", false));
  all.result.lights[0].points[0][1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(count(claims_of(all.scene, all.prepared, all.result, "double", false)), before - 1);
}

TEST(AreaLights, SharesOfPartsAddUpToOne) {
  const Classified all = classify(kAreaScene);
  const LightResult& light = all.result.lights[0];
  ASSERT_GT(all.prepared.first_part[1], 1u);
  for (std::uint32_t polygon = 0; polygon < 5; ++polygon) {
    for (const ClassifiedSide& side : polygon_sides(all.prepared, light, polygon, true)) {
      EXPECT_TRUE(side.area_light);
      EXPECT_FALSE(side.exact_shadow);
      if (side.coplanar) {
        EXPECT_EQ(*side.exact_lit + *side.exact_penumbra + *side.exact_umbra, 1);
        EXPECT_NEAR(side.penumbra.middle(), side.exact_penumbra->get_d(), 1e-12);
        EXPECT_NEAR(side.umbra.middle(), side.exact_umbra->get_d(), 1e-12);
      } else {
        // All of one class.
        EXPECT_EQ(*side.exact_lit + *side.exact_penumbra + *side.exact_umbra, 1);
      }
      EXPECT_LE(side.lit.lower + side.penumbra.lower + side.umbra.lower, 1);
      EXPECT_GE(side.lit.upper + side.penumbra.upper + side.umbra.upper, 1);
    }
  }
}

TEST(AreaLights, SidesStandInOrderAndWhatSeesNothingOnce) {
  const Classified all = classify(kAreaScene);
  const LightResult& light = all.result.lights[0];
  const auto fin = polygon_sides(all.prepared, light, 3, true);
  ASSERT_EQ(fin.size(), 2u);
  EXPECT_EQ(fin[0].side, Side::kFront);
  EXPECT_EQ(fin[1].side, Side::kBack);
  // Three of its nine units are above the light's plane.
  EXPECT_EQ(*fin[0].exact_umbra, mpq_class(1, 3));
  EXPECT_EQ(*fin[1].exact_umbra, mpq_class(1, 3));
  const auto above = polygon_sides(all.prepared, light, 4, true);
  ASSERT_EQ(above.size(), 1u);
  EXPECT_EQ(above[0].reason, ShadowReason::kFacesAway);
  EXPECT_EQ(*above[0].exact_umbra, 1);
  const FacingShare facing = facing_share(all.prepared, light);
  EXPECT_EQ(facing.facing, 4u);
  EXPECT_EQ(facing.away, 1u);
}

TEST(AreaLights, WhatSeesCutsAndReachesBehind) {
  const Classified all = classify(kAreaScene);
  const PreparedLight& panel = all.prepared.lights[0];
  const auto part = [&](std::uint32_t polygon) {
    return all.prepared.parts[all.prepared.first_part[polygon]];
  };
  EXPECT_TRUE(sees_area_light(all.prepared, part(0), Side::kFront, panel));
  EXPECT_FALSE(sees_area_light(all.prepared, part(0), Side::kBack, panel));
  EXPECT_FALSE(cuts_area_light(all.prepared, part(0), panel));
  EXPECT_FALSE(reaches_behind(all.prepared, part(0), panel));
  EXPECT_TRUE(sees_area_light(all.prepared, part(3), Side::kBack, panel));
  EXPECT_TRUE(cuts_area_light(all.prepared, part(3), panel));
  EXPECT_TRUE(reaches_behind(all.prepared, part(3), panel));
  EXPECT_FALSE(sees_area_light(all.prepared, part(4), Side::kFront, panel));
  EXPECT_FALSE(reaches_behind(all.prepared, part(4), panel));
  // Floor 12, roof 8, bent, and the fin twice.
  EXPECT_NEAR(facing_area(all.prepared, {0}),
              12 + 8 + 2 * 9 + nearest_double(precise_area(all.prepared, 2)), 1e-9);
}

TEST(AreaLights, TheOracleGetsWhatWasClassified) {
  const Classified all = classify(kAreaScene);
  const Claims candidate = claims_of(all.scene, all.prepared, all.result, "plane", true);
  ASSERT_EQ(candidate.lights.size(), 2u);
  EXPECT_TRUE(candidate.lights[0].per_caster_umbra);
  EXPECT_FALSE(candidate.lights[1].per_caster_umbra);
  std::size_t behind = 0;
  for (const ClaimedPolygon& polygon : candidate.lights[0].polygons) {
    EXPECT_FALSE(polygon.shadow_fraction);
    EXPECT_TRUE(polygon.umbra_fraction.has_value());
    for (const ClaimedFragment& fragment : polygon.fragments) {
      EXPECT_NE(fragment.state, LightState::kShadow);
      if (fragment.reason.empty()) continue;
      EXPECT_EQ(fragment.reason, polygon.id == "above" ? "faces-away" : "behind-light");
      EXPECT_EQ(fragment.state, LightState::kUmbra);
      ++behind;
    }
  }
  EXPECT_GE(behind, 3u);
}

/// The middle of an enclosure rounds to 1 or 0 where the share is neither for certain.
TEST(ToldShare, IsOneOrZeroOnlyOfWhatIs) {
  EXPECT_EQ(told_share({1, 1}), 1);
  EXPECT_EQ(told_share({0, 0}), 0);
  EXPECT_EQ(told_share({0.25, 0.75}), 0.5);
  const double less = std::nextafter(1.0, 0.0);
  EXPECT_EQ(told_share({less, 1}), less);
  EXPECT_EQ(told_share({0, std::numeric_limits<double>::denorm_min()}),
            std::numeric_limits<double>::denorm_min());
}

}  // namespace
}  // namespace gnomon::report
