// SPDX-License-Identifier: GPL-3.0-or-later
// The readers of OBJ and OFF: what they take, and the place and words of everything they do not.
#include <gmock/gmock.h>

#include "scene_testing.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string obj_error(const std::string& lines) { return error_of(kSquare + lines, "m.obj"); }

TEST(ReadObj, VerticesAndFaces) {
  const Scene scene = scene_of(
      "# comment\r\nmtllib x.mtl\r\n\r\no thing\nv 0 0 0\nv 1. .5 -1e2 1.0\n  v\t1 1 0 0.5 0.5 0.5 "
      "# red\n"
      "v 0 1 0\nvt 0 0\nvn 0 0 1\ng group\nusemtl white\ns off\n"
      "f 1/1/1 2/1/1 3/1/1 4/1/1\nf 1//1 2//1 -1//1\nf 4/1 3/1 2/1\nf -4 -3 -2",
      "dir/thing.obj");
  EXPECT_EQ(scene.name, "thing");
  ASSERT_EQ(scene.vertices.size(), 4u);
  EXPECT_EQ(scene.vertices[1][2], Number(-100.0));
  ASSERT_EQ(scene.polygons.size(), 4u);
  EXPECT_THAT(scene.polygons[0].loop, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(scene.polygons[1].loop, ElementsAre(0, 1, 3));
  EXPECT_THAT(scene.polygons[2].loop, ElementsAre(3, 2, 1));
  EXPECT_THAT(scene.polygons[3].loop, ElementsAre(0, 1, 2));
  EXPECT_EQ(scene.polygons[3].id, "thing/group/3");
}

TEST(ReadObj, ContinuedLines) {
  const Scene scene = scene_of(kSquare + "f 1 2 \\\n 3\\\r\n 4\n", "m.obj");
  EXPECT_THAT(scene.polygons[0].loop, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(obj_error("f 1 2 \\\n 3 x\n"), "6:4: 'x' is not a vertex of a face");
  EXPECT_EQ(scene_of(kSquare + "f 1 2 3 \\", "m.obj").polygons.size(), 1u);
}

TEST(ReadObj, FacesMayComeBeforeTheirVertices) {
  const Scene scene = scene_of("f 1 2 3\n" + kSquare, "m.obj");
  EXPECT_THAT(scene.polygons[0].loop, ElementsAre(0, 1, 2));
}

TEST(ReadObj, NumbersByTheirMeaning) {
  const std::string text = "v 0.1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(scene_of(text, "m.obj").vertices[0][0], Number(0.1));
  ReadOptions decimal;
  decimal.numbers = NumberMeaning::kDecimal;
  const Scene scene = scene_of(text, "m.obj", decimal);
  EXPECT_EQ(scene.numbers, NumberMeaning::kDecimal);
  EXPECT_EQ(scene.vertices[0][0].exact(), mpq_class(1, 10));
}

TEST(ReadObj, Indices) {
  EXPECT_EQ(obj_error("f 1 2 5\n"), "5:7: index 5 is not that of a vertex");
  EXPECT_EQ(obj_error("f 1 0 2\n"), "5:5: index 0");
  EXPECT_EQ(obj_error("f 1 2 -5\n"), "5:7: index -5 goes back beyond the first vertex");
  EXPECT_EQ(obj_error("f 1 2 99999999999\n"), "5:7: index 99999999999 is not that of a vertex");
  EXPECT_EQ(error_of("f 1 2 3\n", "m.obj"), "1:3: index 1 is not that of a vertex");
  EXPECT_EQ(error_of("f -1 -2 -3\n" + kSquare, "m.obj"),
            "1:3: index -1 goes back beyond the first vertex");
  // A line that only looks like a vertex.
  EXPECT_EQ(error_of("# \\\nv 0 0 0\nvt \\\nv 1 1 1\nf 1 1 2\n", "m.obj"),
            "5:7: index 2 is not that of a vertex");
  for (const char* word :
       {"1.0", "1e0", "x", "1/x", "1/1/1/1", "/1", "1/1/x", "+", "1,", "99999999999999999999"}) {
    EXPECT_THAT(obj_error(std::string("f 1 2 ") + word + "\n"),
                HasSubstr("is not a vertex of a face"));
  }
}

TEST(ReadObj, Malformed) {
  EXPECT_EQ(obj_error("f 1 2\n"), "5:1: a face of 2 vertices");
  EXPECT_EQ(obj_error("f 1\n"), "5:1: a face of 1 vertex");
  EXPECT_EQ(obj_error("f\n"), "5:1: a face of 0 vertices");
  EXPECT_EQ(obj_error("v 1 2\n"), "5:1: a vertex of 2 numbers");
  EXPECT_EQ(obj_error("v\n"), "5:1: a vertex of 0 numbers");
  EXPECT_EQ(obj_error("v 1 2 3 4 5 6 7 8 9\n"), "5:1: a vertex of 9 numbers");
  EXPECT_EQ(obj_error("v 1 nan 3\n"), "5:5: 'nan' is not finite");
  EXPECT_EQ(obj_error("v 1 -inf 3\n"), "5:5: '-inf' is not finite");
  EXPECT_EQ(obj_error("v 1 1.#IND 3\n"), "5:5: '1.#IND' is not finite");
  EXPECT_EQ(obj_error("v 1 3.1+e2 3\n"), "5:5: '3.1+e2' is not a number");
  EXPECT_EQ(obj_error("v 1 2 1e999\n"), "5:7: '1e999' is too large for a double");
  EXPECT_EQ(obj_error("v 1 2,5 3\n"), "5:5: '2,5' is not a number");
  EXPECT_EQ(obj_error("v 1 2 3 red\n"), "5:9: 'red' is not a number");
}

TEST(ReadObj, NoScene) {
  EXPECT_EQ(error_of("", "m.obj"), "1:1: the file is empty");
  EXPECT_EQ(error_of("Dear reader,\nno mesh here.\n", "m.obj"), "1:1: no vertex and no face");
  EXPECT_THAT(error_of(std::string("v\0 \0 \0 \0", 8), "m.obj"),
              StartsWith("1:1: the file is not UTF-8"));
  EXPECT_THAT(error_of(kSquare + std::string("f 1 2 3\0", 8), "m.obj"),
              HasSubstr("5:8: a NUL byte"));
  const auto result = parse_scene(kSquare, "m.obj", {});
  ASSERT_TRUE(result);
  EXPECT_THAT(result->warnings, ElementsAre("the scene has no polygons"));
}

TEST(ReadObj, WarnsOfWhatItPassesOver) {
  const auto result = parse_scene(kSquare + "l 1 2\nl 2 3\np 1\nf 1 2 3\n", "m.obj", {});
  ASSERT_TRUE(result);
  EXPECT_THAT(result->warnings,
              ElementsAre("2 line elements (l) ignored", "1 point elements (p) ignored"));
  // Comments in any encoding.
  EXPECT_EQ(obj_error("# gr\xFC\xDF\nf 1 2 3\n"), "ok");
}

const std::string kOffSquare = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(ReadOff, PlainFiles) {
  const Scene scene = scene_of(kOffSquare + "4 0 1 2 3", "m.off");
  EXPECT_EQ(scene.vertices.size(), 4u);
  EXPECT_THAT(scene.polygons[0].loop, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(scene_of("OFF 3 1\n\n0 0 0 # here\n# there\n1 0 0\n0 1 0\n\n3 0 1 2 255 0 0\n# end\n",
                     "m.off")
                .polygons.size(),
            1u);
  EXPECT_EQ(scene_of("\xEF\xBB\xBFOFF\r\n3 1 3\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n", "m.off")
                .vertices.size(),
            3u);
}

TEST(ReadOff, FurtherValuesOfVertices) {
  for (const char* word : {"COFF", "NOFF", "STOFF", "CNOFF", "STCNOFF"}) {
    const Scene scene = scene_of(
        std::string(word) + "\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n3 0 1 2\n",
        "m.off");
    EXPECT_EQ(scene.vertices[2][1], Number(1.0));
  }
}

TEST(ReadOff, Header) {
  EXPECT_EQ(error_of("", "m.off"), "1:1: the file is empty");
  EXPECT_EQ(error_of("8 6 0\n", "m.off"), "1:1: '8' at the start");
  EXPECT_EQ(error_of("4OFF\n1 1 1\n", "m.off"), "1:1: '4OFF': not three dimensions");
  EXPECT_EQ(error_of("nOFF\n3\n", "m.off"), "1:1: 'nOFF': not three dimensions");
  EXPECT_EQ(error_of("OFF BINARY\nxxxx", "m.off"), "1:1: binary OFF");
  EXPECT_EQ(error_of("OFF\n", "m.off"), "2:1: the file ends too early: no number of vertices");
  EXPECT_EQ(error_of("OFF\n-3 1 0\n", "m.off"), "2:1: '-3' is not a number of vertices");
  EXPECT_EQ(error_of("OFF\n3 x 0\n", "m.off"), "2:3: 'x' is not a number of faces");
  EXPECT_EQ(error_of("OFF\n3.0 1 0\n", "m.off"), "2:1: '3.0' is not a number of vertices");
  EXPECT_EQ(error_of("OFF\n0 0 x\n", "m.off"), "2:5: 'x' is not a number of edges");
}

TEST(ReadOff, CountsBeyondTheFile) {
  EXPECT_EQ(error_of("OFF\n353535235358 6 0\n0 0 0\n", "m.off"),
            "2:1: 353535235358 vertices announced");
  EXPECT_EQ(error_of("OFF\n1 9223372036854775807 0\n0 0 0\n", "m.off"),
            "2:3: 9223372036854775807 faces announced");
  EXPECT_THAT(error_of("OFF\n99999999999999999999 6 0\n", "m.off"),
              HasSubstr("is not a number of"));
  EXPECT_EQ(error_of("OFF\n5 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "m.off"),
            "7:7: '2' after the coordinates of a vertex");
  EXPECT_EQ(error_of(kOffSquare + "4 0 1 2 3\n3 0 1 2\n", "m.off"), "8:1: '3' after the last face");
  EXPECT_EQ(error_of("OFF\n3 2 0\n0 0 0.0000000000000\n1 0 0\n0 1 0\n3 0 1 2\n", "m.off"),
            "7:1: the file ends too early: face 1 is missing");
}

TEST(ReadOff, AnyWhiteSpace) {
  for (const char* text : {"OFF\n4 1 0\n0 0 0\n1 0\n0\n1\n1 0\n0 1 0\n4 0 1\n2\n3\n",
                           "OFF 4 1 0  0 0 0  1 0 0  1 1 0  0 1 0  4 0 1 2 3",
                           "OFF\n4\n1\n0\n0 0 0 1 0 0\n1 1 0 0 1 0\n4 0 1 2 3\n",
                           "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1\n2 3 255 0 0\n"}) {
    const Scene scene = scene_of(text, "m.off");
    ASSERT_EQ(scene.vertices.size(), 4u) << text;
    EXPECT_EQ(scene.vertices[2][1], Number(1.0)) << text;
    ASSERT_EQ(scene.polygons.size(), 1u) << text;
    EXPECT_THAT(scene.polygons[0].loop, ElementsAre(0, 1, 2, 3)) << text;
  }
  // Two faces on one line, without colours; and a face that goes on, with an index that is wrong.
  EXPECT_EQ(scene_of("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 3 0 2 3\n", "m.off")
                .polygons.size(),
            2u);
  EXPECT_EQ(error_of("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1\n2 3\n3 0 1\n7\n", "m.off"),
            "10:1: index 7 is not that of a vertex");
  // Colours of vertices that the first word does not announce are no vertices.
  EXPECT_EQ(error_of("OFF\n3 1 0\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2\n", "m.off"),
            "3:7: '1' after the coordinates of a vertex");
}

TEST(ReadOff, Malformed) {
  EXPECT_EQ(error_of("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0 \n3 0 1 2 \n", "m.off"),
            "4:1: vertex 1 has 2 numbers");
  EXPECT_EQ(error_of("OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", "m.off"),
            "4:3: 'inf' is not finite");
  EXPECT_EQ(error_of(kOffSquare + "4 0 1 2 4\n", "m.off"), "7:9: index 4 is not that of a vertex");
  EXPECT_EQ(error_of(kOffSquare + "4 0 1 2 -1\n", "m.off"),
            "7:9: index -1 is not that of a vertex");
  EXPECT_EQ(error_of(kOffSquare + "4 0 1 2\n ", "m.off"), "7:1: a face with 3 of 4 vertices");
  EXPECT_EQ(error_of(kOffSquare + "999999999999 0 1 2\n", "m.off"),
            "7:1: a face with 3 of 999999999999 vertices");
  EXPECT_EQ(error_of(kOffSquare + "2 0 1      \n", "m.off"), "7:1: a face of 2 vertices");
  EXPECT_EQ(error_of(kOffSquare + "3 0 1 2.5  \n", "m.off"), "7:7: '2.5' is not an index");
  EXPECT_EQ(error_of(kOffSquare + "x 0 1 2    \n", "m.off"),
            "7:1: 'x' is not a number of vertices");
}

}  // namespace
}  // namespace gnomon
