// SPDX-License-Identifier: GPL-3.0-or-later
// What is written reads back to the same values, in every format; what a format cannot hold is
// said.
#include "gnomon/scene/write.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "scene_testing.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr SceneFormat kAllFormats[] = {SceneFormat::kJson, SceneFormat::kObj, SceneFormat::kOff,
                                       SceneFormat::kPlyAscii, SceneFormat::kPlyBinary};

std::string text_of(const Scene& scene, SceneFormat format) {
  auto text = scene_to_text(scene, format);
  EXPECT_TRUE(text) << to_string(text.error());
  return text ? text->text : std::string();
}

ReadOptions options_for(const Scene& scene, SceneFormat format) {
  ReadOptions options;
  options.format = format;
  if (format != SceneFormat::kJson) options.numbers = scene.numbers;
  return options;
}

/// Vertices of every magnitude, triangles and longer loops.
Scene random_scene(std::uint64_t seed, NumberMeaning meaning) {
  std::mt19937_64 random(seed);
  Scene scene;
  scene.name = "random";
  scene.numbers = meaning;
  for (int i = 0; i < 200; ++i) {
    Position position;
    for (Number& coordinate : position) {
      if (meaning == NumberMeaning::kDecimal) {
        mpz_class mantissa(std::to_string(random()) + std::to_string(random()));
        if (random() % 2 == 0) mantissa = mantissa % 100000;
        coordinate = Number::from_decimal(mantissa, static_cast<std::int32_t>(random() % 60) - 30);
      } else {
        const double mantissa = static_cast<double>(static_cast<std::int64_t>(random()));
        coordinate = Number(std::ldexp(mantissa, static_cast<int>(random() % 2000) - 1070));
      }
    }
    scene.vertices.push_back(position);
  }
  for (int i = 0; i < 100; ++i) {
    Polygon polygon;
    polygon.id = std::to_string(i);
    const auto count = i == 99 ? 300 : 3 + random() % 5;
    for (std::uint64_t k = 0; k < count; ++k) {
      polygon.loop.push_back(static_cast<VertexId>(random() % 200));
    }
    scene.polygons.push_back(polygon);
  }
  return scene;
}

TEST(Write, JsonHoldsEverything) {
  const Scene scene = scene_of(full_json(), "full.json");
  const std::string text = text_of(scene, SceneFormat::kJson);
  expect_same_scene(scene_of(text, "other.json"), scene);
  EXPECT_EQ(text_of(scene_of(text, "other.json"), SceneFormat::kJson), text);
  EXPECT_THAT(scene_to_text(scene, SceneFormat::kJson)->warnings, ElementsAre());
}

TEST(Write, JsonIsForPeople) {
  Scene scene = scene_of(full_json(), "full.json");
  scene.vertices.resize(3);
  scene.polygons.resize(1);
  scene.polygons[0].holes = {{2, 1, 0}};
  scene.polygons[0].loop = {0, 1, 2};
  scene.lights.resize(1);
  EXPECT_EQ(
      text_of(scene, SceneFormat::kJson),
      "{\"format\": \"gnomon-scene\", \"version\": 1, \"name\": \"t\u00e4ble \\\"1\\\"\", "
      "\"numbers\": \"decimal\", \"two_sided\": true,\n"
      " \"extra\": {\"by\": [\"hand\", 1e999, {\"x\": null}]},\n"
      " \"vertices\": [\n"
      "  [0, 0, 0],\n"
      "  [4, 0, 0],\n"
      "  [4, 4, 0.1]\n"
      " ],\n"
      " \"polygons\": [\n"
      "  {\"id\": \"floor\", \"loop\": [0, 1, 2], \"holes\": [[2, 1, 0]], \"two_sided\": false, "
      "\"casts\": false}\n"
      " ],\n"
      " \"lights\": [\n"
      "  {\"id\": \"bulb\", \"type\": \"point\", \"position\": [1, 1, 3]}\n"
      " ]\n"
      "}\n");
  EXPECT_EQ(text_of(Scene(), SceneFormat::kJson),
            "{\"format\": \"gnomon-scene\", \"version\": 1, \"name\": \"\",\n \"vertices\": [],\n "
            "\"polygons\": []\n}\n");
}

TEST(Write, EveryFormatReadsBack) {
  for (const auto meaning : {NumberMeaning::kDouble, NumberMeaning::kDecimal}) {
    const Scene scene = random_scene(5, meaning);
    for (const SceneFormat format : kAllFormats) {
      if (format == SceneFormat::kPlyBinary && meaning == NumberMeaning::kDecimal) continue;
      const std::string text = text_of(scene, format);
      const Scene back = scene_of(text, "random.x", options_for(scene, format));
      expect_same_scene(back, scene);
      EXPECT_EQ(text_of(back, format), text);
    }
  }
}

TEST(Write, ExtremeDoubles) {
  Scene scene = random_scene(6, NumberMeaning::kDouble);
  using Limits = std::numeric_limits<double>;
  scene.vertices[0] = {Number(Limits::max()), Number(-Limits::min()), Number(Limits::denorm_min())};
  scene.vertices[1] = {Number(1.0 / 3), Number(-0.0), Number(std::nextafter(1.0, 2.0))};
  for (const SceneFormat format : kAllFormats) {
    expect_same_geometry(scene_of(text_of(scene, format), "x", options_for(scene, format)), scene);
  }
}

TEST(Write, NoDecimalBecomesADoubleInSilence) {
  Scene scene = random_scene(7, NumberMeaning::kDecimal);
  for (Position& position : scene.vertices) position = {Number(0.5), Number(1.0), Number(-3.0)};
  expect_same_geometry(scene_of(text_of(scene, SceneFormat::kPlyBinary), "x.ply"), scene);
  scene.vertices[3][1] = Number::from_decimal(1, -1);
  auto text = scene_to_text(scene, SceneFormat::kPlyBinary);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::kNumber);
  EXPECT_EQ(text.error().what, "0.1 is not exactly a double");
  EXPECT_EQ(text.error().where.pointer, "/vertices/3/1");
  scene.numbers = NumberMeaning::kDouble;
  for (const SceneFormat format : kAllFormats) {
    text = scene_to_text(scene, format);
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().where.pointer, "/vertices/3/1");
  }
}

TEST(Write, DoublesInASceneOfDecimalsKeepTheirValue) {
  Scene scene = random_scene(8, NumberMeaning::kDecimal);
  scene.vertices[0][0] = Number(0.1);
  for (const SceneFormat format :
       {SceneFormat::kJson, SceneFormat::kObj, SceneFormat::kOff, SceneFormat::kPlyAscii}) {
    expect_same_geometry(scene_of(text_of(scene, format), "x", options_for(scene, format)), scene);
  }
}

TEST(Write, MeshesSayWhatTheyLeaveOut) {
  const Scene scene = scene_of(full_json(), "full.json");
  const auto text = scene_to_text(scene, SceneFormat::kObj);
  ASSERT_TRUE(text);
  EXPECT_THAT(
      text->warnings,
      ElementsAre("1 hole left out: the format holds vertices and loops only",
                  "the 1 id of polygons left out: the format holds vertices and loops only",
                  "two_sided or casts of 3 polygons left out: the format holds vertices and "
                  "loops only",
                  "3 lights left out: the format holds vertices and loops only",
                  "\"extra\" left out: the format holds vertices and loops only",
                  "the numbers are decimals: read the file with --numbers decimal"));
  EXPECT_THAT(scene_to_text(random_scene(1, NumberMeaning::kDouble), SceneFormat::kOff)->warnings,
              ElementsAre());
}

TEST(Write, NamesCannotBreakAFile) {
  Scene scene = random_scene(9, NumberMeaning::kDouble);
  scene.name = "two\nlines \\\" and \x01\x7F more \\";
  for (const SceneFormat format : kAllFormats) {
    expect_same_geometry(scene_of(text_of(scene, format), "x", options_for(scene, format)), scene);
  }
  EXPECT_EQ(scene_of(text_of(scene, SceneFormat::kJson), "x.json").name, scene.name);
}

}  // namespace
}  // namespace gnomon
