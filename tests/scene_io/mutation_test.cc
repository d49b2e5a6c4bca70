// SPDX-License-Identifier: GPL-3.0-or-later
// Valid files with some bytes changed, doubled or lost: each ends as a scene or as an error with
// words, never otherwise. The seed is fixed; the files are the same everywhere.
#include <gtest/gtest.h>

#include <cstring>
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

constexpr const char* kHbJson =
    R"_({"type": "Model", "identifier": "m", "units": "Feet", "tolerance": 0.01, "properties": {"t)_"
    R"_(ype": "ModelProperties"}, "rooms": [{"identifier": "r", "faces": [{"identifier": "w", "fac)_"
    R"_(e_type": "Wall", "boundary_condition": {"type": "Outdoors"}, "geometry": {"type": "Face3D")_"
    R"_(, "boundary": [[0, 0, 0], [8, 0, 0], [8, 0, 3], [0, 0, 3]], "holes": [[[5, 0, 1], [6, 0, 1)_"
    R"_(], [6, 0, 2]]]}, "apertures": [{"identifier": "a", "geometry": {"type": "Face3D", "boundar)_"
    R"_(y": [[1, -0.004, 1], [3, -0.004, 1], [3, -0.004, 2]]}, "outdoor_shades": [{"identifier": ")_"
    R"_(s", "geometry": {"type": "Face3D", "boundary": [[0, 0, 2.5], [8, 0, 2.5], [8, -0.75, 2.5]])_"
    R"_(}}]}]}, {"identifier": "i", "boundary_condition": {"type": "Surface"}, "doors": [{}]}]}], )_"
    R"_("orphaned_shades": [{"identifier": "t", "geometry": {"type": "Face3D", "boundary": [[0, -6)_"
    R"_(, 0], [9, -6, 0], [9, -6, 2]]}}], "shade_meshes": [{"identifier": "h", "geometry": {"verti)_"
    R"_(ces": [[0, 20, 0], [1, 20, 0], [1, 21, 0], [0, 21, 0]], "faces": [[0, 1, 2, 3]]}}]})_";
constexpr const char* kGbXml =
    R"_(<gbXML lengthUnit="Feet"><Campus id="c"><Surface id="w" surfaceType="ExteriorWall"><Adjace)_"
    R"_(ntSpaceId spaceIdRef="h"/><PlanarGeometry><PolyLoop><CartesianPoint><Coordinate>0</Coordin)_"
    R"_(ate><Coordinate>0</Coordinate><Coordinate>0</Coordinate></CartesianPoint><CartesianPoint><)_"
    R"_(Coordinate>10</Coordinate><Coordinate>0</Coordinate><Coordinate>0</Coordinate></CartesianP)_"
    R"_(oint><CartesianPoint><Coordinate>10</Coordinate><Coordinate>0</Coordinate><Coordinate>10</)_"
    R"_(Coordinate></CartesianPoint><CartesianPoint><Coordinate>0</Coordinate><Coordinate>0</Coord)_"
    R"_(inate><Coordinate>10</Coordinate></CartesianPoint></PolyLoop></PlanarGeometry><Opening id=)_"
    R"_("o" openingType="FixedWindow"><PlanarGeometry><PolyLoop><CartesianPoint><Coordinate>1</Coo)_"
    R"_(rdinate><Coordinate>0</Coordinate><Coordinate>1</Coordinate></CartesianPoint><CartesianPoi)_"
    R"_(nt><Coordinate>2</Coordinate><Coordinate>0</Coordinate><Coordinate>1</Coordinate></Cartesi)_"
    R"_(anPoint><CartesianPoint><Coordinate>2</Coordinate><Coordinate>0</Coordinate><Coordinate>2<)_"
    R"_(/Coordinate></CartesianPoint></PolyLoop></PlanarGeometry></Opening></Surface><Surface id=")_"
    R"_(s" surfaceType="Shade"><PlanarGeometry><PolyLoop><CartesianPoint><Coordinate>0</Coordinate)_"
    R"_(><Coordinate>-1</Coordinate><Coordinate>0</Coordinate></CartesianPoint><CartesianPoint><Co)_"
    R"_(ordinate>1</Coordinate><Coordinate>-1</Coordinate><Coordinate>0</Coordinate></CartesianPoi)_"
    R"_(nt><CartesianPoint><Coordinate>1</Coordinate><Coordinate>-1</Coordinate><Coordinate>1</Coo)_"
    R"_(rdinate></CartesianPoint></PolyLoop></PlanarGeometry></Surface></Campus></gbXML>)_";
constexpr const char* kRadiance =
    R"_(# room
void plastic grey
0
0
5 .5 .5 .5 0 0
grey alias other grey
void light bright
0
0
3 )_"
    R"_(1 1 1
bright source sun
0
0
4 1 -2 3 0.533
!gensky 6 21 12
other polygon wall
0
0
33 0 0 0)_"
    R"_( 9 0 0 9 9 0 0 9 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0 0 0 0
bright polygon panel
0
0
12 0)_"
    R"_( 0 3 0 1 3 1 1 3 1 0 3
)_";
constexpr const char* kStl =
    R"_(solid a
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfa)_"
    R"_(cet
endsolid a
)_";
constexpr const char* kGltf =
    R"_({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": ")_"
    R"_(n", "mesh": 0, "children": [1], "translation": [1, 2.5, 3], "scale": [2, -1, 0.1]}, {"mesh)_"
    R"_(": 0, "rotation": [0, 0, 0.38268343, 0.92387953]}], "meshes": [{"name": "m", "primitives":)_"
    R"_( [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}, {"attributes": {"POSITION")_"
    R"_(: 0}, "mode": 5}]}], "materials": [{"name": "g", "doubleSided": true}], "accessors": [{"bu)_"
    R"_(fferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}, {"bufferView": 1, "compo)_"
    R"_(nentType": 5123, "count": 6, "type": "SCALAR"}], "bufferViews": [{"buffer": 0, "byteLength)_"
    R"_(": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}], "buffers": [{"byteLength": 60,)_"
    R"_( "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAA)_"
    R"_(AIA/AAAAAAAAAAAAAIA/AAABAAIAAAACAAMA"}]})_";

/// The same triangles as binary STL.
std::string binary_stl() {
  std::string text(80, ' ');
  text += std::string("\2\0\0\0", 4);
  for (const float last : {1.0F, 0.5F}) {
    for (const float number :
         {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, last, 0.0F}) {
      char bytes[4];
      std::memcpy(bytes, &number, sizeof bytes);
      text.append(bytes, sizeof bytes);
    }
    text += std::string(2, '\0');
  }
  return text;
}

TEST(Mutation, HbJson) { mutate(kHbJson, "m.hbjson", NumberMeaning::kDecimal); }
TEST(Mutation, GbXml) { mutate(kGbXml, "m.xml", NumberMeaning::kDecimal); }
TEST(Mutation, Radiance) { mutate(kRadiance, "m.rad", NumberMeaning::kDecimal); }
TEST(Mutation, StlAscii) { mutate(kStl, "m.stl", NumberMeaning::kDecimal); }
TEST(Mutation, StlBinary) { mutate(binary_stl(), "m.stl", NumberMeaning::kDouble); }
TEST(Mutation, Gltf) { mutate(kGltf, "m.gltf", NumberMeaning::kDecimal); }

TEST(Mutation, Garbage) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 2000; ++i) {
    std::string text(random() % 300, '\0');
    for (char& c : text) c = static_cast<char>(random());
    for (const char* file :
         {"g", "g.json", "g.obj", "g.off", "g.ply", "g.stl", "g.glb", "g.rad", "g.xml"}) {
      (void)parse_scene(text, file, {});
      (void)parse_scene("ply\nformat binary_big_endian 1.0\n" + text, file, {});
      (void)parse_scene("OFF\n" + text, file, {});
    }
  }
}

}  // namespace
}  // namespace gnomon
