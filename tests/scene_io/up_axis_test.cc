// SPDX-License-Identifier: GPL-3.0-or-later
// Which way is up, and what polygons of OBJ files are called.
#include <gmock/gmock.h>

#include <fstream>

#include "gnomon/scene/write.h"
#include "scene_testing.h"
#include "shown_scene.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ReadOptions y_up() {
  ReadOptions options;
  options.up = UpAxis::kY;
  return options;
}

TEST(UpAxis, VerticesAreTurnedExactly) {
  // A floor of y = 0 that looks up.
  const std::string text = "v 0 0 0\nv 0 0 1\nv 0.1 0 1\nv 5 7 -3\nf 1 2 3\n";
  const Scene scene = scene_of(text, "a.obj", y_up());
  EXPECT_EQ(loop_of(scene, "0"), "(0, 0, 0) (0, -1, 0) (0.1, -1, 0)");
  EXPECT_EQ(shown(scene.vertices[3]), "(5, 3, 7)");
  ReadOptions z_up;
  z_up.up = UpAxis::kZ;
  expect_same_scene(scene_of(text, "a.obj", z_up), scene_of(text, "a.obj"));
  ReadOptions decimals = y_up();
  decimals.numbers = NumberMeaning::kDecimal;
  EXPECT_EQ(
      shown(scene_of("v 0 0 0\nv 1 0 0\nv 0.1 0.2 0.3\nf 1 2 3\n", "a.obj", decimals).vertices[2]),
      "(0.1, -0.3, 0.2)");
}

TEST(UpAxis, LightsAreTurnedToo) {
  const std::string text = R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[1,0,0],[0,1,0]], "polygons": [{"loop": [0,1,2]}],
 "lights": [{"id": "sun", "type": "directional", "to_light": [1,2,3],
             "region": [[[0,0,1],[1,0,1],[0,1,1]]]},
            {"id": "panel", "type": "area", "loop": [[1,1,3],[1,2,3],[2,2,3]]}]})";
  // By the fast way through a file, and from memory.
  const std::string path = ::testing::TempDir() + "up_axis.json";
  std::ofstream(path) << text;
  const auto from_file = read_scene(path, y_up());
  ASSERT_TRUE(from_file) << to_string(from_file.error());
  for (const Scene& scene : {scene_of(text, "a.json", y_up()), from_file->scene}) {
    EXPECT_EQ(shown(scene.lights[0].position), "(1, -3, 2)");
    EXPECT_EQ(shown(scene.lights[0].region[0][1]), "(1, -1, 0)");
    EXPECT_EQ(shown(scene.lights[1].loop[1]), "(1, -3, 2)");
    EXPECT_EQ(shown(scene.vertices[2]), "(0, 0, 1)");
  }
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjNames, AreThoseOfObjectsAndGroups) {
  const Scene scene = scene_of(std::string(kTriangle) +
                                   "f 1 2 3\no wall\nf 1 2 3\nf 1 2 3\ng pane\nf 1 2 3\n"
                                   "g\nf 1 2 3\no roof\ng a b\nf 1 2 3\no wall\ng\nf 1 2 3\n"
                                   "o shed\ng shed\nf 1 2 3\n",
                               "a.obj");
  EXPECT_THAT(ids_of(scene), ElementsAre("0", "wall/0", "wall/1", "wall/pane/0", "wall/2",
                                         "roof/a/b/0", "wall/3", "shed/0"));
}

TEST(ObjNames, OfFacesThatAreLeftOut) {
  ReadOptions options;
  options.skip_bad = true;
  const ReadResult result = read_text(
      std::string(kTriangle) + "g wall\nf 1 2 3\nf 1 2\nf 1 2 9\nf 3 2 1\n", "a.obj", options);
  EXPECT_THAT(ids_of(result.scene), ElementsAre("wall/0", "wall/3"));
  ASSERT_EQ(result.left_out.size(), 2u);
  EXPECT_EQ(result.left_out[0].id, "wall/1");
  EXPECT_THAT(result.scene.extra, HasSubstr(R"("wall":["wall/0","wall/3"])"));
}

TEST(ObjNames, AreWrittenAndReadBack) {
  const Scene scene = scene_of(
      std::string(kTriangle) + "f 1 2 3\ng wall\nf 1 2 3\no x\nf 1 2 3\ng\no\nf 1 2 3\n", "a.obj");
  const auto written = scene_to_text(scene, SceneFormat::kObj);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->warnings, ElementsAre(HasSubstr("\"extra\"")));
  EXPECT_THAT(ids_of(scene_of(written->text, "b.obj")),
              ElementsAre("0", "wall/0", "x/wall/0", "3"));
  Scene other = scene;
  other.polygons[1].id = "south wall/0";  // two words are two groups
  EXPECT_THAT(scene_to_text(other, SceneFormat::kObj)->warnings,
              ElementsAre(HasSubstr("ids"), HasSubstr("\"extra\"")));
}

TEST(ObjNames, CharactersThatNoIdHoldsAreEscaped) {
  const Scene scene = scene_of(std::string(kTriangle) + "o a\x01z\nf 1 2 3\n", "a.obj");
  EXPECT_THAT(ids_of(scene), ElementsAre("a%01z/0"));
}

TEST(ObjWeights, AreToldOf) {
  EXPECT_THAT(read_text("v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0 1 0.5 0.5\nf 1 2 3\n", "a.obj").warnings,
              IsEmpty());
  EXPECT_THAT(read_text("v 0 0 0 2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").warnings,
              ElementsAre("1 vertex has a weight other than 1, which are ignored: the three "
                          "coordinates count"));
}

}  // namespace
}  // namespace gnomon
