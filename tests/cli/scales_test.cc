// SPDX-License-Identifier: GPL-3.0-or-later
// certify on scenes whose areas no double holds, on which a rounded kernel cuts without end, and
// whose error runs through everything: verdicts, shares and widths stay what they are.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <cmath>
#include <numbers>
#include <string>

#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

class Scales : public testing::Test {
 protected:
  std::string write(const Scene& scene) {
    const auto written = scene_to_text(scene, SceneFormat::kJson);
    EXPECT_TRUE(written);
    const std::string file = (directory_.path() / "scene.json").string();
    write_text(file, written->text);
    return file;
  }
  /// An example with all positions times 2^exponent, as doubles.
  std::string scaled_example(const std::string& name, int exponent) {
    auto read = read_scene(GNOMON_EXAMPLES "/" + name + ".json");
    EXPECT_TRUE(read);
    Scene& scene = read->scene;
    scene.numbers = NumberMeaning::kDouble;
    const auto scale = [&](Position& position) {
      for (Number& number : position) number = Number(std::ldexp(number.nearest(), exponent));
    };
    for (Position& vertex : scene.vertices) scale(vertex);
    for (Light& light : scene.lights) {
      if (!light.is_directional()) scale(light.position);
    }
    return write(scene);
  }
  rapidjson::Document certificate(const std::string& scene, const std::string& kernel) {
    const RunResult run =
        run_gnomon({"certify", scene, "--kernel", kernel, "--measure", "--json", "-"});
    rapidjson::Document json;
    json.Parse(run.out.c_str());
    EXPECT_FALSE(json.HasParseError()) << run.out << run.err;
    return json;
  }

  TestDirectory directory_;
};

TEST_F(Scales, AKernelThatCutsWithoutEndGivesUpAlone) {
  const std::string scene = scaled_example("stairs", -365);
  const RunResult run = run_gnomon(
      {"certify", scene, "--kernel", "epick", "--kernel", "double", "--kernel", "plane"});
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("gave up"));
  EXPECT_THAT(run.out, HasSubstr("200000 fragments"));
  EXPECT_THAT(run.out, HasSubstr("Identical to the exact answer: plane"));
  EXPECT_THAT(run.out, HasSubstr("Failed: epick"));
}

TEST_F(Scales, WrongSharesAreRightWhereAreasAreNot) {
  for (const int exponent : {-600, 520}) {
    const auto json = certificate(scaled_example("table-chair", exponent), "double");
    const auto& run = json["runs"][0];
    EXPECT_STREQ(run["verdict"].GetString(), "failed") << exponent;
    EXPECT_GT(run["totals"]["wrong_share"].GetDouble(), 0.1) << exponent;
    EXPECT_LE(run["totals"]["wrong_share"].GetDouble(), 1) << exponent;
    EXPECT_THAT(run["excess"].GetString(), HasSubstr("more than 1e-09")) << exponent;
  }
}

TEST_F(Scales, OneLeastDoubleAmongOthersIsTheGridsAndNotTheWidths) {
  auto read = read_scene(scaled_example("table-chair", 0));
  ASSERT_TRUE(read);
  Scene& scene = read->scene;
  Number* zero = nullptr;
  for (Position& vertex : scene.vertices) {
    for (Number& number : vertex) {
      if (zero == nullptr && number.nearest() == 0) zero = &number;
    }
  }
  ASSERT_NE(zero, nullptr);
  *zero = Number(5e-324);
  const auto json = certificate(write(scene), "double");
  const auto& totals = json["runs"][0]["totals"];
  EXPECT_STREQ(json["runs"][0]["verdict"].GetString(), "within tolerance");
  EXPECT_GT(totals["regions"].GetUint(), 0u);
  EXPECT_LT(totals["width"][1].GetDouble(), 1e-9);
  EXPECT_LT(totals["off_plane"][1].GetDouble(), 1e-9);
}

TEST_F(Scales, ARegionIsNoWiderThanItsAreaAllows) {
  // An umbrella: errors of rounding around one point are one region of very many trapezoids.
  constexpr int kRibs = 80;
  std::string vertices = "[-20,-20,0],[20,-20,0],[20,20,0],[-20,20,0],[1,0.5,6]";
  std::string polygons = R"({"id":"floor","loop":[0,1,2,3]})";
  int last = 4;
  for (int i = 0; i < kRibs; ++i) {
    for (const double turn : {i + 0.0, i + 1.6}) {
      const double angle = 2 * std::numbers::pi * turn / kRibs;
      const int step = turn > i ? 1 : 0;
      vertices += fmt::format(",[{},{},{}]", 1 + 2 * std::cos(angle), .5 + 2 * std::sin(angle),
                              6 + ((3 * i + step) % 8 - 4) / 9.0);
      ++last;
    }
    polygons += fmt::format(R"(,{{"id":"rib{}","loop":[4,{},{}]}})", i, last - 1, last);
  }
  const std::string file = (directory_.path() / "umbrella.json").string();
  write_text(file,
             R"({"format":"gnomon-scene","version":1,"two_sided":true,"vertices":[)" + vertices +
                 R"(],"polygons":[)" + polygons +
                 R"(],"lights":[{"id":"sun","type":"directional","to_light":[0.3,-0.5,0.8]}]})");
  const auto json = certificate(file, "double");
  EXPECT_STREQ(json["runs"][0]["verdict"].GetString(), "within tolerance");
  EXPECT_LT(json["runs"][0]["totals"]["width"][1].GetDouble(), 1e-3);
}

}  // namespace
}  // namespace gnomon::test
