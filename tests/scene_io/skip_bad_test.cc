// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons that cannot be used are left out where that is asked for, and each is named with its
// line; and files of other formats are called by their names.
#include <gmock/gmock.h>

#include "scene_testing.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> left_out(const std::string& text, const std::string& file) {
  ReadOptions options;
  options.skip_bad = true;
  const auto result = parse_scene(text, file, options);
  if (!result) return {to_string(result.error())};
  std::vector<std::string> lines;
  for (const LeftOutPolygon& polygon : result->left_out) {
    lines.push_back(polygon.id + "@" + std::to_string(polygon.why.where.line) + ": " +
                    polygon.why.what);
  }
  for (const Polygon& polygon : result->scene.polygons) lines.push_back("kept " + polygon.id);
  return lines;
}

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv nan 0 0\n";

TEST(SkipBad, Obj) {
  EXPECT_THAT(
      left_out(kVertices + "f 1 2 3 4\nf 1 2\nf 1 2 9\nf 1 2 x\nf 1 2 5\nf 1 2 4 3\nf 1 0 2\nf 3 "
                           "2 1\nv 1 2\nf 1 2 6\n",
               "m.obj"),
      ElementsAre("1@7: a face of 2 vertices", "2@8: index 9 is not that of a vertex",
                  "3@9: 'x' is not a vertex of a face", "4@10: vertex 5: 'nan' is not finite",
                  "5@11: polygon '5': the loop crosses itself: edges 1-3 and 2-0", "6@12: index 0",
                  "8@15: vertex 6: a vertex of 2 numbers", "kept 0", "kept 7"));
}

TEST(SkipBad, Off) {
  EXPECT_THAT(
      left_out("OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 inf 0\n4 0 1 2 3\n3 0 1 9\n4 0 1 3 "
               "2\n3 0 1 4\n",
               "m.off"),
      ElementsAre("1@9: index 9 is not that of a vertex",
                  "2@10: polygon '2': the loop crosses itself: edges 1-3 and 2-0",
                  "3@11: vertex 4: 'inf' is not finite", "kept 0"));
}

TEST(SkipBad, Ply) {
  EXPECT_THAT(
      left_out("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
               "y\nproperty float z\nelement face 3\nproperty list uchar int "
               "vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n2 0 1\n3 "
               "0 1 -1\n",
               "m.ply"),
      ElementsAre("1@15: a face of 2 vertices", "2@16: index -1 is not that of a vertex",
                  "kept 0"));
}

TEST(SkipBad, Json) {
  const std::string head = R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,1e999,0]],
 "polygons": [)";
  EXPECT_THAT(left_out(head + R"(
  {"loop": [0,1,2,3]},
  {"id": "short", "loop": [0,1]},
  {"loop": [0,1,7]},
  {"loop": [0,1,-7]},
  {"loop": [0,1,4]},
  {"loop": [0,1,3,2]},
  {"loop": [0,1,2,3], "holes": [[0,1]]},
  {"loop": [0,1,2,3], "holes": [[0,1,9]]}
 ]})",
                       "s.json"),
              ElementsAre("short@5: a loop of 2 vertices", "2@6: index 7 is not that of a vertex",
                          "3@7: index -7 is not that of a vertex",
                          "4@8: vertex 4: '1e999' is too large for a double",
                          "5@9: polygon '5': the loop crosses itself: edges 1-3 and 2-0",
                          "7@11: index 9 is not that of a vertex", "kept 0", "kept 6"));
  // What is no matter of one polygon stays an error.
  EXPECT_THAT(left_out(head + R"({"loop": "x"}]})", "s.json"),
              ElementsAre(HasSubstr("found a string")));
}

TEST(SkipBad, AllOfThem) {
  ReadOptions options;
  options.skip_bad = true;
  const auto result = parse_scene(kVertices + "f 1 2\n", "m.obj", options);
  ASSERT_TRUE(result);
  EXPECT_THAT(result->scene.polygons, IsEmpty());
  EXPECT_THAT(result->warnings, ElementsAre("the scene has no polygons"));
}

TEST(Holes, OfTwoVerticesAreTaken) {
  const std::string scene = R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "polygons": [{"loop": [0,1,2,3], "holes": [[0,1],[],[2]]}]})";
  EXPECT_EQ(scene_of(scene, "s.json").polygons[0].holes.size(), 3u);
}

std::string foreign(const std::string& text, const std::string& file) {
  const auto result = parse_scene(text, file, {});
  return result ? "read" : result.error().what;
}

TEST(ForeignFormats, AreCalledByTheirNames) {
  const auto is = [](const std::string& name) {
    return "this is " + name + ", which is not read here";
  };
  EXPECT_EQ(foreign(R"({ "type": "CityJSON", "version": "1.1", "CityObjects": {} })", "a.obj"),
            "this is CityJSON, and called OBJ");
  EXPECT_EQ(foreign(R"({"type": "Model", "properties": {"type": "ModelProperties"}})", "a.obj"),
            "this is HBJSON, and called OBJ");
  EXPECT_EQ(foreign(R"({"asset": {"version": "2.0"}, "meshes": []})", "a.off"),
            "this is glTF, and called OFF");
  EXPECT_EQ(foreign(R"({"type": "FeatureCollection"})", "a.json"), is("GeoJSON"));
  EXPECT_EQ(foreign("<?xml version=\"1.0\"?>\n<gbXML xmlns=\"x\">\n</gbXML>", "a.obj"),
            "this is gbXML, and called OBJ");
  EXPECT_EQ(foreign("<core:CityModel>", "a.obj"), is("CityGML"));
  EXPECT_EQ(foreign("<a/>", "a.json"), is("XML"));
  EXPECT_EQ(foreign("! comment\n\nBuildingSurface:Detailed,\n  wall;\n", "a.obj"),
            "this is IDF, and called OBJ");
  EXPECT_EQ(foreign("solid cube\nfacet normal 0 0 1\n", "a.ply"), "this is STL, and called PLY");
  EXPECT_EQ(foreign("glTF\2", "a.obj"), "this is binary glTF, and called OBJ");
  EXPECT_EQ(foreign("<core:CityModel>", "a.xml"), is("CityGML"));
  EXPECT_EQ(foreign("ISO-10303-21;\nHEADER;", "a.ifc"), is("STEP (such as IFC)"));
  // A broken file of a format that is read says what is broken.
  EXPECT_THAT(foreign("{\"format\": \"gnomon-scene\", \"asset\": {}}", "a.json"),
              HasSubstr("unknown key 'asset'"));
}

}  // namespace
}  // namespace gnomon
