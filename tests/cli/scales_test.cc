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

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

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

/// log10 of an area in JSON, as a number where that tells it, else as text beside it.
double logarithm(const rapidjson::Value& object, const char* name) {
  const std::string decimal = std::string(name) + "_decimal";
  if (!object.HasMember(decimal.c_str())) return std::log10(object[name].GetDouble());
  const std::string text = object[decimal.c_str()].GetString();
  const auto at = text.find('e');
  return std::log10(std::stod(text.substr(0, at))) + std::stod(text.substr(at + 1));
}

TEST_F(Scales, AreasAreToldAtEveryScale) {
  const auto shadows = [&](int exponent) {
    const RunResult run = run_gnomon({"shadows", scaled_example("table-chair", exponent)});
    rapidjson::Document json;
    json.Parse(run.out.c_str());
    EXPECT_FALSE(json.HasParseError()) << run.out << run.err;
    EXPECT_EQ(run.out.find("_decimal") == std::string::npos, std::abs(exponent) < 500) << exponent;
    return json;
  };
  const auto known = shadows(0);
  for (const int exponent : {-1000, -600, -530, -400, 400, 520, 1000}) {
    const auto json = shadows(exponent);
    const double scale = 2 * exponent * std::log10(2.0);
    const auto& sides = json["lights"][0]["polygons"];
    for (rapidjson::SizeType i = 0; i < sides.Size(); ++i) {
      const auto& own = known["lights"][0]["polygons"][i];
      EXPECT_NEAR(logarithm(sides[i], "area"), logarithm(own, "area") + scale, 1e-9) << exponent;
      for (const char* share : {"lit", "shadow"}) {
        const auto& area = own[share]["area"];
        if (area.GetDouble() == 0) {
          EXPECT_EQ(sides[i][share]["area"].GetDouble(), 0) << exponent;
          EXPECT_FALSE(sides[i][share].HasMember("area_decimal")) << exponent;
        } else {
          EXPECT_NEAR(logarithm(sides[i][share], "area"), logarithm(own[share], "area") + scale,
                      1e-9)
              << exponent;
        }
      }
    }
  }
}

TEST_F(Scales, AreasOfVerdictsAreToldAtEveryScale) {
  const auto logarithm_of_bound = [](const rapidjson::Value& text) {
    rapidjson::Document object(rapidjson::kObjectType);
    object.AddMember("x_decimal", rapidjson::Value(text, object.GetAllocator()),
                     object.GetAllocator());
    return logarithm(object, "x");
  };
  const auto known = certificate(scaled_example("table-chair", 0), "double");
  for (const char* name : {"area", "lit", "shadow"}) {
    EXPECT_FALSE(known["runs"][0]["totals"].HasMember((std::string(name) + "_decimal").c_str()));
  }
  for (const int exponent : {-1000, -600, 520, 1000}) {
    const auto json = certificate(scaled_example("table-chair", exponent), "double");
    const double scale = 2 * exponent * std::log10(2.0);
    EXPECT_NEAR(logarithm(json, "facing_area"),
                std::log10(known["facing_area"].GetDouble()) + scale, 1e-9);
    const auto& totals = json["runs"][0]["totals"];
    for (const char* name : {"area", "lit", "shadow"}) {
      const auto& bounds = totals[(std::string(name) + "_decimal").c_str()];
      const auto& own = known["runs"][0]["totals"][name];
      EXPECT_NEAR(logarithm_of_bound(bounds[0]), std::log10(own[0].GetDouble()) + scale, 1e-9);
      EXPECT_NEAR(logarithm_of_bound(bounds[1]), std::log10(own[1].GetDouble()) + scale, 1e-9);
      EXPECT_LE(logarithm_of_bound(bounds[0]), logarithm_of_bound(bounds[1]) + 1e-12);
    }
    EXPECT_GE(totals["misclassified"][0].GetDouble(), 0) << exponent;
  }
}

TEST_F(Scales, EveryStepOfScaleIsJudged) {
  const RunResult run =
      run_gnomon({"extremes", "scale-up", "--from", "550", "--to", "550", "--kernel", "longdouble",
                  "--kernel", "double", "--algorithm", "sectors", "--curves"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, Not(HasSubstr("not judged")));
  EXPECT_THAT(run.out, ContainsRegex("sectors +double +- +550 +misclassified"));
  EXPECT_THAT(run.out, ContainsRegex("sectors +longdouble +- +never"));
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
