// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/scene/digest.h"

#include "gnomon/scene/write.h"
#include "scene_testing.h"

namespace gnomon {
namespace {

Scene small_scene(const std::string& numbers) {
  return scene_of(R"({"format": "gnomon-scene", "version": 1, "name": "t", "numbers": ")" +
                      numbers +
                      R"(", "vertices": [[0,0.5,-12],[1000,2.5e-1,0],[0,0,400]],
 "polygons": [{"loop": [0,1,2], "holes": [[2,1,0]]}, {"loop": [0,2,1], "two_sided": true, "casts": false}]})",
                  "t.json");
}

TEST(Digest, IsThatOfTheDocumentedText) {
  // printf 'gnomon-geometry 1\nv 0 1:-1:0 -3:2:0\nv 1:3:3 1:-2:0 0\nv 0 0 1:4:2\np c 0 1 2\nh 2 1
  // 0\n
  //         p t 0 2 1\n' | sha256sum
  EXPECT_EQ(geometry_digest(small_scene("double")),
            "sha256:9029d6ae1be2c19f5157ae092afdd049783d1a3912a6534b03b097ee579d7d28");
}

TEST(Digest, EqualValuesAreEqual) {
  EXPECT_EQ(geometry_digest(small_scene("double")), geometry_digest(small_scene("decimal")));
  Scene scene = small_scene("double");
  scene.vertices[0][1] = Number::from_decimal(mpz_class("5" + std::string(50, '0')), -51);
  scene.name = "other";
  scene.polygons[0].id = "renamed";
  scene.polygons[0].two_sided = false;
  EXPECT_EQ(geometry_digest(scene), geometry_digest(small_scene("double")));
}

TEST(Digest, EverythingOfTheGeometryCounts) {
  const std::string digest = geometry_digest(small_scene("double"));
  Scene scene = small_scene("double");
  scene.vertices[0][0] = Number(5e-324);
  EXPECT_NE(geometry_digest(scene), digest);
  scene = small_scene("double");
  scene.vertices[0][1] = Number::from_decimal(mpz_class("5" + std::string(50, '0') + "1"), -52);
  EXPECT_NE(geometry_digest(scene), digest);
  scene = small_scene("double");
  std::swap(scene.polygons[0].loop[0], scene.polygons[0].loop[1]);
  EXPECT_NE(geometry_digest(scene), digest);
  scene = small_scene("double");
  scene.polygons[0].holes.clear();
  EXPECT_NE(geometry_digest(scene), digest);
  scene = small_scene("double");
  scene.polygons[0].casts = false;
  EXPECT_NE(geometry_digest(scene), digest);
  scene = small_scene("double");
  scene.two_sided = true;
  EXPECT_NE(geometry_digest(scene), digest);
}

}  // namespace
}  // namespace gnomon
