// SPDX-License-Identifier: GPL-3.0-or-later
// The reader of gnomon-pixels: what it takes, and the place that each error names.
#include "gnomon/result/pixel_claims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Scene scene() {
  Scene result;
  for (const char* id : {"floor", "roof"}) {
    Polygon polygon;
    polygon.id = id;
    result.polygons.push_back(polygon);
  }
  for (const auto& [id, type] :
       {std::pair{"lamp", LightType::kPoint}, std::pair{"sun", LightType::kDirectional},
        std::pair{"panel", LightType::kArea}}) {
    Light light;
    light.id = id;
    light.type = type;
    result.lights.push_back(light);
  }
  return result;
}

const std::string kGood = R"({"format": "gnomon-pixels", "version": 1, "scene": "s",
 "camera": {"eye": [1, "2.5", -3e0], "right": [32767, 0, 0], "up": [0, 5, 0], "forward": [0, 0, -9]},
 "width": 3, "height": 2, "lights": ["sun", "lamp"], "polygons": ["roof", "floor"], "other": {},
 "rows": [[[2, 1, 3], [1, -1, 0]],
          [[1, 0, 2], [1, 0, 1], [1, 0, 0]]]})";

std::string with(std::string_view from, std::string_view to) {
  std::string text = kGood;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string message(const std::string& text) {
  const auto claims = parse_pixel_claims(text, "p.json", scene());
  return claims ? "accepted" : to_string(claims.error());
}

TEST(PixelClaims, AreReadAsTheyAreWritten) {
  const auto claims = parse_pixel_claims(kGood, "p.json", scene());
  ASSERT_TRUE(claims) << to_string(claims.error());
  EXPECT_EQ(claims->camera.eye[1].nearest(), 2.5);
  EXPECT_EQ(claims->camera.eye[2].nearest(), -3.0);
  EXPECT_THAT(claims->camera.right, ElementsAre(32767, 0, 0));
  EXPECT_THAT(claims->lights, ElementsAre(1, 0));
  constexpr std::uint32_t kNothing = PixelClaims::kNothing;
  EXPECT_THAT(claims->polygon, ElementsAre(0, 0, kNothing, 1, 1, 1));
  EXPECT_THAT(claims->lit_by, ElementsAre(3, 3, 0, 2, 1, 0));
}

TEST(PixelClaims, ErrorsNameTheirPlace) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "the file is empty"},
      {"[]", "an array"},
      {with("gnomon-pixels", "gnomon-result"), "/format"},
      {with("\"version\": 1", "\"version\": 2"), "/version"},
      {with("\"width\": 3", "\"width\": 0"), "/width"},
      {with("\"width\": 3", "\"width\": 99999999999"), "/width"},
      {with("\"height\": 2", "\"height\": 3"), "2 rows; expected 3, the height (at /rows)"},
      {with("[1, \"2.5\", -3e0]", "[1, 2]"), "/camera/eye"},
      {with("\"2.5\"", "\"two\""), "/camera/eye/1"},
      {with("32767", "32768"), "/camera/right/0"},
      {with("32767", "1.5"), "/camera/right/0"},
      {with("\"lamp\"]", "\"lump\"]"), "/lights/1"},
      {with("\"lamp\"]", "\"panel\"]"), "an area light"},
      {with("\"lamp\"]", "\"sun\"]"), "second time"},
      {with("\"roof\"", "\"root\""), "/polygons/0"},
      {with("[2, 1, 3]", "[2, 2, 3]"), "/rows/0/0/1"},
      {with("[2, 1, 3]", "[2, -2, 3]"), "/rows/0/0/1"},
      {with("[2, 1, 3]", "[2, 1, 4]"), "/rows/0/0/2"},
      {with("[2, 1, 3]", "[2, 1, -1]"), "/rows/0/0/2"},
      {with("[2, 1, 3]", "[4, 1, 3]"), "/rows/0/0/0"},
      {with("[2, 1, 3]", "[0, 1, 3]"), "/rows/0/0/0"},
      {with("[2, 1, 3]", "[1, 1, 3]"), "runs of 2 samples; expected 3, the width (at /rows/0)"},
      {with("[2, 1, 3]", "[2, 1]"), "/rows/0/0"},
      {with("[2, 1, 3]", "7"), "/rows/0/0"},
      {with("\"lights\"", "\"lamps\""), "lights"},
  };
  for (const auto& [text, part] : cases) EXPECT_THAT(message(text), HasSubstr(part)) << text;
  EXPECT_THAT(message(kGood.substr(0, kGood.size() - 3)), HasSubstr("p.json:"));
}

TEST(PixelClaims, AMissingFileIsAnError) {
  const auto claims = read_pixel_claims("/nowhere/p.json", scene());
  ASSERT_FALSE(claims);
  EXPECT_EQ(claims.error().code, ErrorCode::kFile);
}

}  // namespace
}  // namespace gnomon
