// SPDX-License-Identifier: GPL-3.0-or-later
// Valid files with some bytes changed, doubled or lost: each ends as a scene or as an error with
// words, never otherwise. The seed is fixed; the files are the same everywhere.
#include <gtest/gtest.h>

#include <random>

#include "gnomon/scene/digest.h"
#include "gnomon/scene/validate.h"
#include "gnomon/scene/write.h"
#include "mutated.h"
#include "scene_testing.h"

namespace gnomon {
namespace {

constexpr int kMutations = 4000;

void mutate(const std::string& text, const std::string& file, NumberMeaning meaning) {
  std::mt19937_64 random(1992);
  ReadOptions options;
  options.numbers = meaning;
  ASSERT_TRUE(parse_scene(text, file, options));
  int scenes = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string changed = mutated(text, random);
    const auto result = parse_scene(changed, file, options);
    if (!result) {
      const Error& error = result.error();
      ASSERT_FALSE(error.what.empty()) << i;
      ASSERT_EQ(error.where.file, file) << i;
      ASSERT_EQ(to_string(error).find('\n'), std::string::npos) << i << ": " << to_string(error);
      continue;
    }
    ++scenes;
    ASSERT_TRUE(validate_scene(result->scene)) << i;
    ASSERT_FALSE(geometry_digest(result->scene).empty());
    const auto written = scene_to_text(result->scene, SceneFormat::kJson);
    ASSERT_TRUE(written) << i;
    expect_same_scene(scene_of(written->text, "back.json"), result->scene);
  }
  // Both ends are reached.
  EXPECT_GT(scenes, kMutations / 100);
  EXPECT_LT(scenes, kMutations);
}

Scene mesh() {
  return scene_of(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.25 -1e2\nf 1 2 3 4\nf 5 4 3\nf 1 2 5\nf 3 2 1 5 "
      "4\n",
      "mesh.obj");
}

std::string mesh_text(SceneFormat format) { return scene_to_text(mesh(), format)->text; }

TEST(Mutation, Json) { mutate(full_json(), "m.json", NumberMeaning::kDecimal); }
TEST(Mutation, Obj) { mutate(mesh_text(SceneFormat::kObj), "m.obj", NumberMeaning::kDouble); }
TEST(Mutation, Off) { mutate(mesh_text(SceneFormat::kOff), "m.off", NumberMeaning::kDouble); }
TEST(Mutation, PlyAscii) {
  mutate(mesh_text(SceneFormat::kPlyAscii), "m.ply", NumberMeaning::kDecimal);
}
TEST(Mutation, PlyBinary) {
  mutate(mesh_text(SceneFormat::kPlyBinary), "m.ply", NumberMeaning::kDouble);
}

TEST(Mutation, Garbage) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 2000; ++i) {
    std::string text(random() % 300, '\0');
    for (char& c : text) c = static_cast<char>(random());
    for (const char* file : {"g", "g.json", "g.obj", "g.off", "g.ply"}) {
      (void)parse_scene(text, file, {});
      (void)parse_scene("ply\nformat binary_big_endian 1.0\n" + text, file, {});
      (void)parse_scene("OFF\n" + text, file, {});
    }
  }
}

}  // namespace
}  // namespace gnomon
