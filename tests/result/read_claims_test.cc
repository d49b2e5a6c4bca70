// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/result/read_claims.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

namespace gnomon {
namespace {

Expected<Claims> parse(const std::string& text, NumberMeaning numbers = NumberMeaning::kDouble) {
  Scene scene;
  scene.numbers = numbers;
  return parse_claims(text, "r.json", scene);
}

std::string with_fragment(const std::string& fragment) {
  return R"({"lights":[{"id":"sun","polygons":[{"id":"a","fragments":[)" + fragment + "]}]}]}";
}

std::string message(const std::string& text) {
  const Expected<Claims> found = parse(text);
  return found ? "no error" : to_string(found.error());
}

TEST(ReadClaims, AResultOfOurs) {
  const Expected<Claims> found = parse(R"({ "format": "gnomon-result", "version": 1,
    "scene": "table", "kernel": "plane", "exact": true, "lights": [ {"id": "bulb", "polygons": [
      {"id": "floor", "side": "back", "area": 16.0,
       "lit": {"fraction": "3/4", "area": 12.0}, "shadow": {"fraction": 0.25, "area": 4.0},
       "fragments": [ {"class": "shadow", "loop": [[0,0,0],[1e0,0,0],[0,1.5,0]], "caster": "quad",
                       "exact_loop": [["0","0","0"],["1/3","0","0"],["0","-3/2",0]]},
                      {"class": "lit", "loop": [[0.1,0,0],[1,0,0],[0,1,0]]} ] } ] } ] })");
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  const ClaimedPolygon& polygon = found->lights.at(0).polygons.at(0);
  EXPECT_EQ(polygon.side, Side::kBack);
  EXPECT_TRUE(polygon.side_given);
  EXPECT_EQ(polygon.lit_fraction, mpq_class(3, 4));
  EXPECT_FALSE(polygon.shadow_fraction.has_value());
  ASSERT_EQ(polygon.fragments.size(), 2u);
  EXPECT_TRUE(polygon.fragments[0].exact);
  EXPECT_EQ(polygon.fragments[0].caster, "quad");
  EXPECT_EQ(polygon.fragments[0].loop[1][0], mpq_class(1, 3));
  EXPECT_EQ(polygon.fragments[0].loop[2][1], mpq_class(-3, 2));
  EXPECT_EQ(polygon.fragments[1].loop[0][0], mpq_class(0.1));
}

TEST(ReadClaims, ForeignResultsAndDecimals) {
  const Expected<Claims> found = parse(
      R"({"made by": {"x": [1, null, true]}, "lights": [{"id": "s", "background": "lit",
          "polygons": [{"id": "a", "fragments": [{"class": "shadow",
          "loop": [[0.1,0,0],[1,0,0],[0,1,0]], "colour": 3}]}]}]})",
      NumberMeaning::kDecimal);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_EQ(found->lights[0].background, LightState::kLit);
  EXPECT_FALSE(found->lights[0].polygons[0].side_given);
  EXPECT_EQ(found->lights[0].polygons[0].fragments[0].loop[0][0], mpq_class(1, 10));
}

TEST(ReadClaims, AreaLights) {
  const Expected<Claims> found = parse(R"({"lights": [
      {"id": "a", "umbra": "per-caster", "polygons": [{"id": "p", "side": "front",
        "lit": {"fraction": "1/4"}, "penumbra": {"fraction": "1/2"}, "umbra": {"fraction": "1/4"},
        "fragments": [{"class": "penumbra", "loop": [[0,0,0],[1,0,0],[0,1,0]], "caster": "q"},
                      {"class": "umbra", "loop": [[0,0,0],[1,0,0],[0,1,0]],
                       "reason": "behind-light"}]},
        {"id": "p", "side": "back", "fragments": []}]},
      {"id": "b", "polygons": []}]})");
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_TRUE(found->lights[0].per_caster_umbra);
  EXPECT_FALSE(found->lights[1].per_caster_umbra);
  const ClaimedPolygon& front = found->lights[0].polygons.at(0);
  EXPECT_EQ(front.penumbra_fraction, mpq_class(1, 2));
  EXPECT_EQ(front.umbra_fraction, mpq_class(1, 4));
  EXPECT_EQ(front.fragments[0].state, LightState::kPenumbra);
  EXPECT_EQ(front.fragments[1].reason, "behind-light");
  EXPECT_EQ(found->lights[0].polygons[1].side, Side::kBack);
  EXPECT_TRUE(parse(R"({"umbra": "per-caster", "lights": [{"id": "b", "polygons": []}]})")
                  ->lights[0]
                  .per_caster_umbra);
  EXPECT_NE(message(R"({"umbra": "deep", "lights": []})").find("/umbra"), std::string::npos);
}

TEST(ReadClaims, HowFragmentsAreMeant) {
  const Expected<Claims> found = parse(R"({"cover": "overlay", "background": "lit", "lights": [
      {"id": "a", "polygons": [{"id": "p", "fragments": [
        {"class": "shadow", "loop": [[0,0,0],[3,0,0],[0,3,0]],
         "holes": [[[1,1,0],[1.5,1,0],[1,1.5,0]]]},
        {"class": "lit", "loop": [[9,9,9]], "exact_loop": [["1/3",0,0],[1,0,0],[0,1,0]],
         "exact_holes": [[["1/7",0,0]]]}]}]},
      {"id": "b", "background": "shadow", "cover": "partition", "polygons": []}]})");
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  const ClaimedLight& light = found->lights[0];
  EXPECT_EQ(light.cover, Cover::kOverlay);
  EXPECT_EQ(light.background, LightState::kLit);
  EXPECT_FALSE(light.listed);
  EXPECT_EQ(found->lights[1].cover, Cover::kPartition);
  EXPECT_EQ(found->lights[1].background, LightState::kShadow);
  const std::vector<ClaimedFragment>& fragments = light.polygons[0].fragments;
  EXPECT_LT(fragments[0].level, fragments[1].level);
  EXPECT_EQ(fragments[0].holes.at(0).at(1)[0], mpq_class(3, 2));
  EXPECT_EQ(fragments[1].holes.at(0).at(0)[0], mpq_class(1, 7));

  const Expected<Claims> listed =
      parse(R"({"lights": [{"id": "a", "listed": ["penumbra", "umbra"], "polygons": []},
                           {"id": "b", "listed": [], "polygons": []}]})");
  ASSERT_TRUE(listed.has_value()) << to_string(listed.error());
  EXPECT_EQ(listed->lights[0].listed->size(), 2u);
  EXPECT_TRUE(listed->lights[1].listed->empty());

  const auto light_of = [](const std::string& terms) {
    return message(R"({"lights": [{"id": "a", "polygons": [], )" + terms + "}]}");
  };
  EXPECT_NE(light_of(R"("cover": "layers")").find("/lights/0/cover"), std::string::npos);
  EXPECT_NE(light_of(R"("cover": "overlay")").find("background"), std::string::npos);
  EXPECT_NE(light_of(R"("listed": ["lit", "dark"])").find("/lights/0/listed/1"), std::string::npos);
  EXPECT_NE(light_of(R"("listed": ["lit"], "background": "lit")").find("/lights/0"),
            std::string::npos);
}

TEST(ReadClaims, PiecesOfLights) {
  const Expected<Claims> found = parse(R"({"lights": [{"id": "a/0", "piece_of": "a",
      "exact_loop": [["1/3",0,0],[1,0,0],[0,1,0]], "polygons": []}]})");
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_EQ(found->lights[0].piece_of, "a");
  EXPECT_EQ(found->lights[0].piece_loop.at(0)[0], mpq_class(1, 3));
  EXPECT_NE(message(R"({"lights": [{"id": "a/0", "piece_of": "a", "polygons": []}]})")
                .find("\"loop\" is missing"),
            std::string::npos);
}

TEST(ReadClaims, SeveralLightsAtOnce) {
  const Expected<Claims> found = parse(R"({
      "combined": [{"id": "p", "side": "back", "fragments": [
        {"lit_by": ["a", "b"], "penumbra_of": ["c"], "loop": [[0,0,0],[1,0,0],[0,1,0]]},
        {"lit_by": [], "loop": [], "exact_loop": [["1/3",0,0]]}]}],
      "overlay": [{"id": "p", "painted": [
        {"level": 2, "dark_for": ["a"], "on": 1, "loop": [[0,0,0],[1,0,0],[0,1,0]]},
        {"level": 1, "dark_for": ["a"], "on": -1, "loop": [[0,0,0],[1,0,0],[0,1,0]]}]}]})");
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  const SharedPolygon& combined = found->combined->at(0);
  EXPECT_EQ(combined.side, Side::kBack);
  EXPECT_EQ(combined.fragments.at(0).lit_by, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(combined.fragments[0].penumbra_of, (std::vector<std::string>{"c"}));
  EXPECT_FALSE(combined.fragments[0].exact);
  EXPECT_TRUE(combined.fragments[1].exact);
  EXPECT_EQ(combined.fragments[1].loop.at(0)[0], mpq_class(1, 3));
  const SharedPolygon& overlay = found->overlay->at(0);
  EXPECT_FALSE(overlay.side_given);
  EXPECT_EQ(overlay.fragments.at(0).level, 2u);
  EXPECT_EQ(overlay.fragments[0].on, 1u);
  EXPECT_FALSE(overlay.fragments[1].on);

  const auto at = [](const std::string& text, const std::string& place) {
    EXPECT_NE(message(text).find(place), std::string::npos) << message(text);
  };
  at(R"({"combined": 1})", "/combined");
  at(R"({"combined": [{"id": "p", "fragments": [{"loop": []}]}]})", "/combined/0/fragments/0");
  at(R"({"combined": [{"id": "p", "fragments": [{"lit_by": ["a", 2], "loop": []}]}]})",
     "/combined/0/fragments/0/lit_by/1");
  const std::string painted = R"({"overlay": [{"id": "p", "painted": [{"dark_for": [], "loop": [])";
  at(painted + "}]}]}", "/overlay/0/painted/0");
  at(painted + R"(, "level": -1}]}]})", "/overlay/0/painted/0/level");
  at(painted + R"(, "level": 1.5}]}]})", "/overlay/0/painted/0/level");
  at(painted + R"(, "level": 1, "on": -2}]}]})", "/overlay/0/painted/0/on");
  at(painted + R"(, "level": 1, "on": 1e9}]}]})", "/overlay/0/painted/0/on");
}

/// The shares of a side of polygon "a" under light "sun", of a file with others besides.
std::vector<ToldShare> told(const std::string& members, const std::string& others = "") {
  const std::string text =
      R"({"lights": [{"id": "sun", "polygons": [{"id": "a", )" + members + "}" + others + "]}]}";
  Scene scene;
  const Expected<Claims> found = parse_claims(text, "r.json", scene, SharesAlone::kTaken);
  EXPECT_TRUE(found) << to_string(found.error());
  if (!found) return {};
  EXPECT_TRUE(found->lights.at(0).shares_alone);
  return found->lights[0].polygons.at(0).told;
}

TEST(ReadClaims, SharesAloneInEverySpelling) {
  for (const auto& [member, value, rounding] :
       {std::tuple{R"("lit": 0.46875)", mpq_class(15, 32), mpq_class(1, 200'000)},
        {R"("lit": {"fraction": 0.47})", mpq_class(47, 100), mpq_class(1, 200)},
        {R"("lit": 4.7e-1)", mpq_class(47, 100), mpq_class(1, 200)},
        {R"("lit": "0.470")", mpq_class(47, 100), mpq_class(1, 2000)},
        {R"("lit": "15/32")", mpq_class(15, 32), mpq_class(0)},
        {R"("lit": {"fraction": "1"})", mpq_class(1), mpq_class(0)}}) {
    const std::vector<ToldShare> found = told(member);
    ASSERT_EQ(found.size(), 1u) << member;
    EXPECT_EQ(found[0].value, value) << member;
    EXPECT_EQ(found[0].rounding, rounding) << member;
    EXPECT_FALSE(found[0].is_area);
  }
  const std::vector<ToldShare> areas =
      told(R"("lit": {"area": 12}, "penumbra": {"area": 1.50}, "umbra": 0.125)");
  ASSERT_EQ(areas.size(), 3u);
  EXPECT_TRUE(areas[0].is_area);
  EXPECT_EQ(areas[0].rounding, mpq_class(1, 2));
  EXPECT_EQ(areas[1].state, LightState::kPenumbra);
  EXPECT_EQ(areas[1].value, mpq_class(3, 2));
  EXPECT_EQ(areas[1].rounding, mpq_class(1, 200));
  EXPECT_EQ(areas[2].state, LightState::kUmbra);
}

TEST(ReadClaims, ADoubleIsNotHeldToMoreThanItsOwnDigits) {
  // 1/3 in a double, which is off by 2e-17, and what a sum of doubles leaves.
  for (const std::string share :
       {"0.3333333333333333", "0.33333333333333348", "0.3000000000000000"}) {
    EXPECT_TRUE(told("\"lit\": " + share).at(0).is_double) << share;
    EXPECT_EQ(told("\"lit\": " + share).at(0).rounding, mpq_class(0x1p-52));
  }
  EXPECT_FALSE(told("\"lit\": 0.33333333333333").at(0).is_double);
  EXPECT_FALSE(told("\"lit\": \"333333333333333333/1000000000000000000\"").at(0).is_double);
  // What is printed in as few digits as tell a double may have few.
  EXPECT_TRUE(told(R"("lit": 0.25, "shadow": 0.75000000000000011)").at(0).is_double);
  EXPECT_EQ(told("\"lit\": 1e-20").at(0).rounding, mpq_class(0x1p-52));
}

// Zeros at the end of a number are often left out.
TEST(ReadClaims, AWholeShareIsRoundedLikeTheRestOfTheFile) {
  const auto rounding = [](const std::string& lit, const std::string& other) {
    return told(R"("lit": )" + lit, R"(, {"id": "b", "lit": )" + other + "}").at(0).rounding;
  };
  EXPECT_EQ(rounding("1", "0.12345"), mpq_class(1, 20'000));  // five digits: %.5g writes 0.99996 so
  EXPECT_EQ(rounding("0", "0.12345"), mpq_class(1, 200'000));  // five decimals
  EXPECT_EQ(rounding("1.0", "0.12345"), mpq_class(1, 20'000));
  EXPECT_EQ(rounding("1.000", "1"), mpq_class(1, 2000));
  EXPECT_EQ(rounding("1", "0"), mpq_class(1, 2'000'000'000));
  EXPECT_EQ(rounding("1", R"("1/3")"), mpq_class(1, 2'000'000'000));
  EXPECT_EQ(rounding("0.5", "0.12345"), mpq_class(1, 20));
}

TEST(ReadClaims, UnknownFormsAreNamed) {
  const auto said = [](const std::string& text, const std::string& file = "r.json") {
    const Expected<Claims> found = parse_claims(text, file, Scene{}, SharesAlone::kTaken);
    return found ? "no error" : to_string(found.error());
  };
  const auto of_polygon = [&](const std::string& members) {
    return said(R"({"lights": [{"id": "sun", "polygons": [{"id": "a")" + members + "}]}]}");
  };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(of_polygon(R"(, "sunlit": 0.5)"),
      "an object with \"id\", \"sunlit\" has neither fragments nor shares");
  has(of_polygon(R"(, "sunlit": 0.5)"), "/lights/0/polygons/0");
  has(of_polygon(R"(, "lit": "47%")"), "the text \"47%\" is no share of the polygon");
  has(of_polygon(R"(, "lit": {"percent": 47})"), "an object with \"percent\" is no share");
  has(of_polygon(R"(, "lit": [0.5, 0.5])"), "an array is no share");
  has(of_polygon(R"(, "shadow": true)"), "/lights/0/polygons/0/shadow");
  has(of_polygon(R"(, "lit": {"area": null})"), "/lit/area");
  has(of_polygon(R"(, "lit": 1e-5000)"), "/lit");
  has(said("light,x,y,z,visible\nsun,0,0,0,1\n"), "a table of samples (CSV)");
  has(said("Surface Name,wall\n01/01 01:00,0.5\n"), "a table of surfaces by time (CSV)");
  has(said("<html>"), "XML or HTML");
  has(said("a,b\n1,2\n", "r.csv"), "a table (CSV)");
  has(said(R"({"samples": []})"), "this is an object with \"samples\"");
  // Who needs fragments says so.
  has(message(R"({"lights": [{"id": "sun", "polygons": [{"id": "a", "lit": 1}]}]})"),
      "key \"fragments\" is missing");
  has(message(R"({"lights": [{"id": "sun", "polygons": [{"id": "a", "lit": 1}]}]})"),
      "gnomon certify --candidate");
}

TEST(ReadClaims, HugeExponentsOfSharesAreNoTrouble) {
  const std::vector<ToldShare> found = told(R"("lit": 0e-999999999)");
  EXPECT_EQ(found.at(0).value, 0);
}

TEST(ReadClaims, EveryErrorHasAPlace) {
  EXPECT_EQ(message(""), "r.json:1:1: the file is empty; expected a result in JSON, UTF-8");
  EXPECT_NE(message("{\n \"lights\": [1,\n").find("r.json:3:1"), std::string::npos);
  EXPECT_NE(message("[]").find("not an object"), std::string::npos);
  EXPECT_NE(message("{}").find("\"lights\" is missing"), std::string::npos);
  EXPECT_NE(message(R"({"lights": 3})").find("/lights"), std::string::npos);
  EXPECT_NE(message(R"({"format": "gnomon-scene"})").find("/format"), std::string::npos);
  EXPECT_NE(message(R"({"lights": [{"polygons": []}]})").find("/lights/0"), std::string::npos);
  const std::string at = "/lights/0/polygons/0/fragments/0";
  EXPECT_NE(message(with_fragment(R"({"class": "dark", "loop": []})")).find(at + "/class"),
            std::string::npos);
  EXPECT_NE(message(with_fragment(R"({"class": "lit"})")).find(at), std::string::npos);
  EXPECT_NE(message(with_fragment(R"({"class": "lit", "loop": [[0, 1]]})")).find(at + "/loop/0"),
            std::string::npos);
  EXPECT_NE(
      message(with_fragment(R"({"class": "lit", "loop": [[0, 1, "2"]]})")).find(at + "/loop/0/2"),
      std::string::npos);
  EXPECT_NE(
      message(with_fragment(R"({"class": "lit", "loop": [[0, 1, 1e999]]})")).find("r.json:1:"),
      std::string::npos);
  EXPECT_NE(message(with_fragment(R"({"class": "lit", "exact_loop": [[0, 1, "1/0"]]})"))
                .find(at + "/exact_loop/0/2"),
            std::string::npos);
}

TEST(ReadClaims, DeepNestingIsNoCrash) {
  std::string text = R"({"x": )";
  text.append(300'000, '[');
  EXPECT_FALSE(parse(text).has_value());
  text.append(300'000, ']');
  text += R"(, "lights": []})";
  EXPECT_TRUE(parse(text).has_value());
}

TEST(ReadClaims, AFileThatIsNotThere) {
  const Expected<Claims> found = read_claims("no/such/file.json", Scene{});
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, ErrorCode::kFile);
}

}  // namespace
}  // namespace gnomon
