// SPDX-License-Identifier: GPL-3.0-or-later
// What a page is made of: documents that no text can end, numbers as base64, the view of a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "report/page/page_text.h"
#include "report/page/page_writer.h"
#include "report/page/scene_view.h"
#include "report/text/base64.h"
#include "report/text/csv_field.h"
#include "report/text/shell_word.h"

namespace gnomon::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Base64, IsThatOfTheStandard) {
  const auto of = [](std::string_view text) {
    return base64_of(std::as_bytes(std::span(text.data(), text.size())));
  };
  // RFC 4648, section 10.
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  const std::array<std::uint32_t, 2> numbers = {1, 0xffffffff};
  EXPECT_EQ(base64_of(std::span<const std::uint32_t>(numbers)), "AQAAAP////8=");
}

TEST(ShellWord, IsQuotedWhereItHasTo) {
  EXPECT_EQ(shell_word("room.json"), "room.json");
  EXPECT_EQ(shell_word("--at=51.99,4.35"), "--at=51.99,4.35");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("my room"), "'my room'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
}

TEST(CsvLine, QuotesWhatItHasTo) {
  std::string text;
  append_csv_line(text, {"a", "b,c", "say \"d\""});
  EXPECT_EQ(text, "a,\"b,c\",\"say \"\"d\"\"\"\n");
}

TEST(Page, NoTextEndsADocument) {
  if (page_text().empty()) GTEST_SKIP() << "built without the page";
  StringSink sink;
  PageHead head;
  head.command = "certify";
  head.scene = "</script><script>alert(1)</script><!--";
  const PageDocument document = {"certificate", [](TextSink& to) {
                                   to.write("{\"a\": \"</scr");
                                   to.write("ipt>\"}\n");
                                 }};
  write_page(sink, head, std::span(&document, 1));
  const std::string& page = sink.text();
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(page, HasSubstr("{\"a\": \"\\u003c/script>\"}"));
  EXPECT_THAT(page, HasSubstr("id=\"gnomon-data-page\""));
  EXPECT_THAT(page, testing::StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  std::size_t bytes = 0;
  for (const std::string_view text : page_text().before) bytes += text.size();
  for (const std::string_view text : page_text().after) bytes += text.size();
  EXPECT_LT(bytes, 1'000'000u);
}

class View : public testing::Test {
 protected:
  View() {
    make_scene();
    prepared_ = *prepare(scene_);
    light_.id = "sun";
    ClaimedPolygon floor;
    floor.id = "floor";
    for (int i = 0; i < 2; ++i) {
      ClaimedFragment fragment;
      fragment.state = i == 0 ? LightState::kLit : LightState::kShadow;
      fragment.caster = i == 0 ? "" : "floor";
      fragment.loop = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}};
      if (i == 1) fragment.holes = {{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}}};
      floor.fragments.push_back(fragment);
    }
    light_.polygons = {floor};
  }

  rapidjson::Document view(std::uint64_t most_points = kMostViewPoints) {
    StringSink sink;
    const ViewLayer layer = {"double", &light_};
    write_scene_view(sink, scene_, prepared_, std::span(&layer, 1), most_points);
    rapidjson::Document json;
    json.Parse(sink.text().c_str());
    EXPECT_FALSE(json.HasParseError());
    return json;
  }

  Scene scene_;
  PreparedScene prepared_;
  ClaimedLight light_;

 private:
  void make_scene() {
    for (const auto& [x, y] : {std::array{0., 0.}, {4., 0.}, {4., 4.}, {0., 4.}}) {
      scene_.vertices.push_back({Number(x), Number(y), Number(0.)});
    }
    Polygon floor;
    floor.id = "floor";
    floor.loop = {0, 1, 2, 3};
    scene_.polygons = {floor};
    Light sun;
    sun.id = "sun";
    sun.type = LightType::kDirectional;
    sun.position = {Number(0.), Number(0.), Number(1.)};
    scene_.lights = {sun};
  }
};

TEST_F(View, HasTheSceneAboutItsCentre) {
  const rapidjson::Document json = view();
  EXPECT_STREQ(json["format"].GetString(), "gnomon-view");
  EXPECT_EQ(json["centre"][0].GetDouble(), 2);
  EXPECT_EQ(json["lights"][0]["to_light"][2].GetDouble(), 1);
  // One ring of four points, which is no hole.
  EXPECT_STREQ(json["parts"]["rings"].GetString(), "CAAAAA==");
}

TEST_F(View, HasFragmentsWithHolesAndCasters) {
  const rapidjson::Document json = view();
  const auto& layer = json["layers"][0];
  EXPECT_STREQ(layer["run"].GetString(), "double");
  EXPECT_EQ(layer["fragments"].GetInt(), 2);
  EXPECT_STREQ(layer["state"].GetString(), "AAE=");
  // No caster, and polygon 0.
  EXPECT_STREQ(layer["caster"].GetString(), "/////wAAAAA=");
  // Two loops of three points and a hole of three.
  EXPECT_STREQ(layer["rings"].GetString(), "BgAAAAYAAAAHAAAA");
}

TEST_F(View, SaysWhatItLeavesOut) {
  const rapidjson::Document json = view(8);
  const auto& layer = json["layers"][0];
  EXPECT_FALSE(layer.HasMember("points"));
  EXPECT_THAT(layer["left_out"].GetString(), HasSubstr("9 points, more than the 8"));
  EXPECT_TRUE(view(9)["layers"][0].HasMember("points"));
}

}  // namespace
}  // namespace gnomon::report
