// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/result/read_claims.h"

#include <gtest/gtest.h>

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
