// SPDX-License-Identifier: GPL-3.0-or-later
// Codes of scenes: any bytes are a valid scene within the limits, a scene that can be written as a
// code comes back the same, and the degenerate steps do what they say.
#include "fuzz/generate/scene_code.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/validate.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {
namespace {

using Code = std::vector<std::uint8_t>;

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.numbers, b.numbers);
  EXPECT_EQ(a.two_sided, b.two_sided);
  EXPECT_EQ(a.vertices, b.vertices);
  ASSERT_EQ(a.polygons.size(), b.polygons.size());
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    EXPECT_EQ(a.polygons[i].loop, b.polygons[i].loop);
    EXPECT_EQ(a.polygons[i].holes, b.polygons[i].holes);
    EXPECT_EQ(a.polygons[i].two_sided, b.polygons[i].two_sided);
    EXPECT_EQ(a.polygons[i].casts, b.polygons[i].casts);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].type, b.lights[i].type);
    EXPECT_EQ(a.lights[i].position, b.lights[i].position);
    EXPECT_EQ(a.lights[i].loop, b.lights[i].loop);
  }
}

TEST(SceneCode, AnyBytesAreAValidSceneWithinTheLimits) {
  Random random(1989);
  const SceneCodeLimits limits{.vertices = 20, .polygons = 6, .lights = 2, .loop = 7};
  int prepared = 0, with_lights = 0;
  for (int i = 0; i < 3000; ++i) {
    Code code(random.below(120));
    for (auto& byte : code) byte = static_cast<std::uint8_t>(random.below(256));
    // Operands that are small numbers reach further than noise.
    if (i % 2 == 1) {
      for (auto& byte : code) byte %= 20;
    }
    const Scene scene = scene_from_code(code, limits);
    const auto valid = validate_scene(scene);
    ASSERT_TRUE(valid) << i << ": " << to_string(valid.error());
    ASSERT_LE(scene.vertices.size(), limits.vertices);
    ASSERT_LE(scene.polygons.size(), limits.polygons);
    ASSERT_LE(scene.lights.size(), limits.lights);
    for (const Polygon& polygon : scene.polygons) ASSERT_LE(polygon.loop.size(), limits.loop);
    if (const auto again = code_of_scene(scene)) expect_same(scene, scene_from_code(*again));
    with_lights += !scene.lights.empty();
    prepared += !scene.polygons.empty() && prepare(scene).has_value();
  }
  EXPECT_GT(with_lights, 500);
  EXPECT_GT(prepared, 200);
}

TEST(SceneCode, ScenesOfFilesComeBack) {
  const auto scene = [](const std::string& numbers) {
    return parse_scene(R"({"format": "gnomon-scene", "version": 1, "numbers": ")" + numbers +
                           R"(", "two_sided": true,
 "vertices": [[0,0,0],[4,0,0],[4,4,0.1],[0,-127,0],[1e-300,1,0],[2,1,123456789.25],[63,64,-65]],
 "polygons": [{"loop": [0,1,2,3], "holes": [[4,5,6]], "two_sided": false, "casts": false},
              {"loop": [3,2,1], "two_sided": true}],
 "lights": [{"type": "directional", "to_light": [0.3,0.2,1]},
            {"type": "area", "loop": [[1,1,3],[1,2,3],[2,2,3],[2,1,3.5]]}]})",
                       "scene.json")
        .value()
        .scene;
  };
  const auto as_double = code_of_scene(scene("double"));
  ASSERT_TRUE(as_double);
  EXPECT_LT(as_double->size(), 200u);
  expect_same(scene("double"), scene_from_code(*as_double));
  // As a decimal, 1e-300 is beyond the code.
  EXPECT_FALSE(code_of_scene(scene("decimal")));
  Scene decimal = scene("decimal");
  decimal.vertices[4][0] = Number::parse("1e-100", NumberMeaning::kDecimal).value();
  const auto as_decimal = code_of_scene(decimal);
  ASSERT_TRUE(as_decimal);
  expect_same(decimal, scene_from_code(*as_decimal));
}

TEST(SceneCode, MostGeneratedScenesThatAreSmallHaveOne) {
  int codes = 0;
  for (const GeneratorInfo& info : generators()) {
    if (!info.small) continue;
    const Scene scene = generate(info.name).value();
    const SceneCodeLimits limits{.vertices = 255, .polygons = 100, .lights = 4, .loop = 32};
    const auto code = code_of_scene(scene, limits);
    if (!code) continue;
    ++codes;
    expect_same(scene, scene_from_code(*code, limits));
  }
  EXPECT_GT(codes, 5);
}

TEST(SceneCode, TheStepsMakeDegeneracy) {
  // Two lattice points, one moved by an ulp, one between them, a parallelogram, its copy reversed,
  // a light on the line of its edge, one in the shape of the polygon.
  const Code code = {0,  0,                                 // doubles, scale 1
                     0,  1, 1, 0,  0, 5, 1, 0, 0, 5, 5, 0,  // vertices 0, 1, 2
                     2,  1, 0, 1,                           // 3: vertex 1, x, one ulp up
                     3,  0, 1, 4,                           // 4: the middle of 0 and 1
                     7,  8, 0, 1,  2,                       // polygon 0 and vertex 5, reversed
                     10, 0, 0, 1,                           // polygon 1: the same, turned by one
                     12, 0, 1, 16,                          // at 0 + 2 (1 - 0)
                     16, 0, 0};                             // a panel
  const Scene scene = scene_from_code(code);
  ASSERT_EQ(scene.vertices.size(), 6u);
  EXPECT_EQ(scene.vertices[3][0], Number(std::nextafter(5.0, 6.0)));
  EXPECT_EQ(scene.vertices[4], (Position{Number(3.0), Number(1.0), Number(0.0)}));
  EXPECT_EQ(scene.vertices[5], (Position{Number(1.0), Number(5.0), Number(0.0)}));
  ASSERT_EQ(scene.polygons.size(), 2u);
  EXPECT_EQ(scene.polygons[0].loop, (std::vector<VertexId>{5, 2, 1, 0}));
  EXPECT_EQ(scene.polygons[1].loop, (std::vector<VertexId>{2, 1, 0, 5}));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].position, (Position{Number(9.0), Number(1.0), Number(0.0)}));
  EXPECT_EQ(scene.lights[1].loop.size(), 4u);
}

}  // namespace
}  // namespace gnomon::fuzz
