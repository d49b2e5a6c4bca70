// SPDX-License-Identifier: GPL-3.0-or-later
// CityJSON and CityJSONSeq: exact coordinates, levels of detail, solids, holes, templates,
// semantics, and where each kind of bad file goes wrong.
#include <gmock/gmock.h>

#include <fstream>

#include "gnomon/scene/digest.h"
#include "gnomon/scene/groups.h"
#include "gnomon/scene/write.h"
#include "scene_testing.h"
#include "tests/support/test_directory.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kVertices = R"("vertices": [[0,0,0],[4000,0,0],[4000,3000,0],[0,3000,0],
  [0,0,2500],[4000,0,2500],[4000,3000,2500],[0,3000,2500],
  [1000,0,500],[2000,0,500],[2000,0,1500],[1000,0,1500]])";
constexpr const char* kTransform =
    R"("transform": {"scale": [0.001, 0.001, 0.001], "translate": [100000.1, 200000.25, -3.5]})";

std::string file_of(const std::string& objects, const std::string& more = kTransform,
                    const std::string& version = "\"2.0\"") {
  return R"({"CityObjects": {)" + objects + "},\n" + kVertices + ",\n" + more +
         ",\n\"version\": " + version + R"(, "type": "CityJSON"})";
}

std::string box(const std::string& more = "") {
  return R"({"boundaries": [[ [[0,3,2,1]], [[4,5,6,7]], [[0,1,5,4],[8,9,10,11]],
    [[1,2,6,5]], [[2,3,7,6]], [[3,0,4,7]] ]], "type": "Solid", "lod": "2")" +
         more + "}";
}

std::string object(const std::string& name, const std::string& geometries) {
  return "\"" + name + R"(": {"type": "Building", "geometry": [)" + geometries + "]}";
}

Position position(const char* x, const char* y, const char* z) {
  const auto number = [](const char* text) {
    return *Number::parse(text, NumberMeaning::kDecimal);
  };
  return {number(x), number(y), number(z)};
}

std::vector<std::string> ids(const Scene& scene) {
  std::vector<std::string> all;
  for (const Polygon& polygon : scene.polygons) all.push_back(polygon.id);
  return all;
}

TEST(CityJson, IsExactInDecimals) {
  const Scene scene = scene_of(file_of(object("house", box())), "house.city.json");
  EXPECT_EQ(scene.name, "house");
  EXPECT_EQ(scene.numbers, NumberMeaning::kDecimal);
  ASSERT_EQ(scene.polygons.size(), 6u);
  EXPECT_THAT(ids(scene),
              ElementsAre("house/0", "house/1", "house/2", "house/3", "house/4", "house/5"));
  const Polygon& front = scene.polygons[2];
  ASSERT_EQ(front.holes.size(), 1u);
  EXPECT_EQ(scene.vertices[front.loop[1]], position("100004.1", "200000.25", "-3.5"));
  EXPECT_EQ(scene.vertices[front.holes[0][2]], position("100002.1", "200000.25", "-2"));
  for (const Polygon& polygon : scene.polygons) EXPECT_FALSE(scene.is_two_sided(polygon));
}

TEST(CityJson, AsDoublesEachIsTheNearest) {
  ReadOptions options;
  options.numbers = NumberMeaning::kDouble;
  const Scene scene = scene_of(file_of(object("a", box())), "a.json", options);
  EXPECT_EQ(scene.vertices[scene.polygons[2].loop[1]][0], Number(100004.1));
}

TEST(CityJson, TheHighestLevelOfDetailOrTheOneAskedFor) {
  const std::string flat = R"({"type": "MultiSurface", "lod": "0", "boundaries": [[[0,1,2,3]]]})";
  const std::string finer = R"({"type": "CompositeSurface", "lod": "2.2",
    "boundaries": [[[0,1,5,4]], [[1,2,6,5]]]})";
  const std::string text =
      file_of(object("a", flat + "," + finer + "," + box()) + "," + object("b", flat));
  const Scene scene = scene_of(text, "a.json");
  EXPECT_THAT(ids(scene), ElementsAre("a/0", "a/1", "b/0"));
  // A surface of no solid has no inside.
  EXPECT_TRUE(scene.is_two_sided(scene.polygons[0]));
  ReadOptions options;
  options.lod = "2";
  const auto asked = parse_scene(text, "a.json", options);
  ASSERT_TRUE(asked) << to_string(asked.error());
  EXPECT_EQ(asked->scene.polygons.size(), 6u);
  EXPECT_THAT(asked->warnings, ElementsAre("1 city object has no geometry of level of detail 2: "
                                           "left out; in the file: 0, 2, 2.2"));
  options.lod = "two";
  EXPECT_EQ(code_of(text, "a.json", options), ErrorCode::kUsage);
  options.lod = "2";
  EXPECT_EQ(code_of("v 0 0 0\n", "a.obj", options), ErrorCode::kUsage);
}

TEST(CityJson, GroupsAreObjectsAndKindsOfSurfaces) {
  const std::string semantics = R"(, "semantics": {"surfaces": [{"type": "RoofSurface"},
    {"type": "WallSurface"}, {"type": "GroundSurface"}], "values": [[2, 0, 1, 1, null, 1]]})";
  const Scene scene = scene_of(
      file_of(object("a#1", box(semantics)) + "," + object("RoofSurface", box())), "a.json");
  EXPECT_EQ(scene.polygons[0].id, "a%231/0");
  const auto groups = polygon_groups(scene);
  ASSERT_TRUE(groups) << to_string(groups.error());
  ASSERT_EQ(groups->size(), 5u);
  EXPECT_EQ((*groups)[0].name, "a#1");
  EXPECT_EQ((*groups)[1].name, "RoofSurface");
  EXPECT_THAT((*groups)[1].polygons, ElementsAre(6, 7, 8, 9, 10, 11));
  EXPECT_EQ((*groups)[2].name, "GroundSurface");
  EXPECT_EQ((*groups)[3].name, "RoofSurface surfaces");
  EXPECT_THAT((*groups)[3].polygons, ElementsAre(1));
  EXPECT_THAT((*groups)[4].polygons, ElementsAre(2, 3, 5));
  EXPECT_THAT(scene.extra, HasSubstr(R"("semantics":["GroundSurface","RoofSurface surfaces")"));
  // They survive as a scene of our own.
  const auto json = scene_to_text(scene, SceneFormat::kJson);
  ASSERT_TRUE(json);
  expect_same_scene(scene_of(json->text, "back.json"), scene);
}

TEST(CityJson, SolidsThatLookInwardsAreTurned) {
  const std::string inwards = R"({"boundaries": [[ [[0,1,2,3]], [[7,6,5,4]], [[4,5,1,0]],
    [[5,6,2,1]], [[6,7,3,2]], [[7,4,0,3]] ]], "type": "Solid", "lod": "1"})";
  const auto result = parse_scene(file_of(object("a", inwards)), "a.json", {});
  ASSERT_TRUE(result);
  EXPECT_THAT(result->warnings, ElementsAre("1 solid looks inwards, against the standard: "
                                            "turned over"));
  const Scene good = scene_of(file_of(object("a", box())), "a.json");
  const auto up = [](const Scene& scene) {  // twice the area of the second surface, the top
    const auto& loop = scene.polygons[1].loop;
    const auto at = [&](std::size_t i, std::size_t axis) {
      return scene.vertices[loop[i]][axis].nearest() - scene.vertices[loop[0]][axis].nearest();
    };
    return at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0);
  };
  EXPECT_GT(up(good), 0);
  EXPECT_GT(up(result->scene), 0);
}

TEST(CityJson, SeveralSolidsAndShells) {
  const std::string shell = "[ [[0,3,2,1]], [[4,5,6,7]], [[0,1,5,4]] ]";
  for (const char* type : {"MultiSolid", "CompositeSolid"}) {
    const std::string geometry = R"({"type": ")" + std::string(type) + R"(", "lod": "1",
      "boundaries": [[)" + shell +
                                 "," + shell + "],[" + shell + R"(]],
      "semantics": {"surfaces": [{"type": "WallSurface"}], "values": [[[0,0,null],null],null]}})";
    const Scene scene = scene_of(file_of(object("a", geometry)), "a.json");
    EXPECT_EQ(scene.polygons.size(), 9u) << type;
    EXPECT_THAT((*polygon_groups(scene))[1].polygons, ElementsAre(0, 1));
  }
}

TEST(CityJson, TemplatesAreMovedExactly) {
  const std::string instance = R"({"type": "GeometryInstance", "template": 0, "boundaries": [1],
    "transformationMatrix": [0,-1,0,0, 2.5,0,0,0.1, 0,0,1,0, 0,0,0,1]})";
  const std::string templates = R"("geometry-templates": {"templates": [
      {"type": "MultiSurface", "lod": "3", "boundaries": [[[0,1,2]]]}],
    "vertices-templates": [[0,0,0],[1.5,0,0],[0,0.2,1e-3]]}, )" +
                                std::string(kTransform);
  const Scene scene = scene_of(file_of(object("tree", instance), templates), "a.json");
  ASSERT_EQ(scene.polygons.size(), 1u);
  // The anchor is (100004.1, 200000.25, -3.5).
  EXPECT_EQ(scene.vertices[0], position("100004.1", "200000.35", "-3.5"));
  EXPECT_EQ(scene.vertices[1], position("100004.1", "200004.1", "-3.5"));
  EXPECT_EQ(scene.vertices[2], position("100003.9", "200000.35", "-3.499"));
}

TEST(CityJson, AnInstanceThatMirrorsASolidTurnsItsLoops) {
  const std::string instance = R"({"type": "GeometryInstance", "template": 0, "boundaries": [0],
    "transformationMatrix": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]})";
  const std::string templates = R"("geometry-templates": {"templates": [
      {"type": "Solid", "lod": 1, "boundaries": [[[[0,2,1]],[[0,1,3]],[[1,2,3]],[[2,0,3]]]]}],
    "vertices-templates": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]}, )" +
                                std::string(kTransform);
  const auto result = parse_scene(file_of(object("a", instance), templates), "a.json", {});
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_THAT(result->warnings, IsEmpty());
  EXPECT_THAT(result->scene.polygons[0].loop, ElementsAre(2, 1, 0));
}

TEST(CityJson, Version10NeedsNoTransform) {
  const std::string text = R"({"type": "CityJSON", "version": "1.0", "CityObjects": {
    "a": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": 1.3,
      "boundaries": [[[0,1,2]]]}]}}, "vertices": [[0.1,0,0],[1e400,0,0],[0,1.25,3]]})";
  const Scene scene = scene_of(text, "a.json");
  EXPECT_EQ(scene.vertices[1][0].exponent(), 400);
  EXPECT_EQ(scene.vertices[2], position("0", "1.25", "3"));
}

TEST(CityJson, WhatHasNoSurfacesIsCounted) {
  const auto result = parse_scene(
      file_of(object("a", R"({"type": "MultiPoint", "boundaries": [0,1], "lod": "0"})") +
              R"(, "b": {"type": "BuildingPart"})"),
      "a.json", {});
  ASSERT_TRUE(result);
  EXPECT_THAT(result->warnings,
              ElementsAre("1 geometry of type MultiPoint ignored: it has no surfaces",
                          "the scene has no polygons"));
}

TEST(CityJson, BadFilesEndInOneErrorAtItsPlace) {
  const auto geometry = [](const std::string& text) { return file_of(object("a", text)); };
  const auto surface = [&](const std::string& rings) {
    return geometry(R"({"type": "MultiSurface", "lod": "1", "boundaries": [)" + rings + "]}");
  };
  const std::string at = " @/CityObjects/a/geometry/0";
  EXPECT_EQ(error_of(surface("[[0,1,12]]"), "a.json"),
            "1:115: index 12 is not that of a vertex" + at + "/boundaries/0/0/2");
  EXPECT_EQ(error_of(surface("[[0,1,-2]]"), "a.json"),
            "1:115: index -2 is not that of a vertex" + at + "/boundaries/0/0/2");
  EXPECT_EQ(error_of(surface("[[0,1,99999999999]]"), "a.json"),
            "1:115: index 99999999999 is not that of a vertex" + at + "/boundaries/0/0/2");
  EXPECT_EQ(error_of(surface("[[0,1,2.5]]"), "a.json"),
            "1:115: '2.5' is not an integer" + at + "/boundaries/0/0/2");
  EXPECT_EQ(error_of(surface("[[0,1]]"), "a.json"),
            "1:110: a ring of 2 vertices" + at + "/boundaries/0/0");
  EXPECT_EQ(error_of(surface("[]"), "a.json"),
            "1:109: a surface without rings" + at + "/boundaries/0");
  EXPECT_EQ(error_of(surface("[[[0,1,2]]]"), "a.json"),
            "1:111: found an array" + at + "/boundaries/0/0/0");
  EXPECT_EQ(error_of(surface("[0,1,2]"), "a.json"),
            "1:110: found a number" + at + "/boundaries/0/0");
  EXPECT_EQ(error_of(geometry(R"({"type": "Sphere"})"), "a.json"),
            "1:66: a geometry of type 'Sphere'" + at + "/type");
  EXPECT_EQ(error_of(geometry(R"({"type": "GeometryInstance", "template": 0})"), "a.json"),
            "1:98: index 0 is not that of a template" + at + "/template");
  EXPECT_EQ(
      error_of(geometry(box(R"(, "semantics": {"surfaces": [], "values": [[0]]})")), "a.json"),
      "2:118: index 0 is not that of a semantic surface" + at + "/semantics/values/0/0");
  EXPECT_EQ(error_of(geometry(box(R"(, "semantics": {"surfaces": [{"type": "x"}],
    "values": [[0,0]]})")),
                     "a.json"),
            "3:16: semantics for 2 of these" + at + "/semantics/values/0");
  EXPECT_EQ(error_of(file_of(object("a", box()) + "," + object("a", box())), "a.json"),
            "2:78: a second city object 'a' @/CityObjects/a");
}

TEST(CityJson, BadHeads) {
  const std::string a = object("a", box());
  EXPECT_EQ(error_of(file_of(a, kTransform, "\"3.0\""), "a.json"),
            "7:12: CityJSON of version '3.0' @/version");
  EXPECT_EQ(error_of(file_of(a, kTransform, "2.0"), "a.json"), "7:12: found a number @/version");
  EXPECT_EQ(error_of(file_of(a, R"("x": 1)"), "a.json"), "1:1: the key 'transform' is missing");
  EXPECT_EQ(error_of(file_of(a, R"("transform": {"scale": [1,1,1]})"), "a.json"),
            "6:14: the key 'translate' is missing @/transform");
  EXPECT_EQ(
      error_of(file_of(a, R"("transform": {"scale": [1,1], "translate": [0,0,0]})"), "a.json"),
      "6:24: this is no vector @/transform/scale");
  const std::string whole = file_of(a);
  EXPECT_THAT(error_of(whole.substr(0, whole.size() - 30), "a.json"),
              HasSubstr("the file ends too early"));
  EXPECT_THAT(error_of(whole.substr(0, 60), "a.city.json"), HasSubstr("the file ends too early"));
  EXPECT_EQ(error_of(R"({"CityObjects": {}, "vertices": [], "type": "CityJSON"})", "a.json"),
            "1:1: the key 'version' is missing");
  EXPECT_EQ(error_of(R"({"CityObjects": {}, "vertices": [], "version": "1.0"})", "a.json"),
            "1:1: the key 'type' is missing");
  EXPECT_EQ(error_of(file_of(a, R"("transform": {"scale": [1,1,1], "translate": [1e4097,0,0]})"),
                     "a.json"),
            "6:47: '1e4097' has an exponent beyond +-4096 @/transform/translate/0");
}

TEST(CityJson, SkipBadLeavesSurfacesOut) {
  ReadOptions options;
  options.skip_bad = true;
  const std::string text = file_of(object("a", R"({"type": "MultiSurface", "lod": "1",
    "boundaries": [[[0,1,2,3]],
                   [[0,1]],
                   [[0,1,77]],
                   [[4,5,6]]]})"));
  const auto result = parse_scene(text, "a.json", options);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_THAT(ids(result->scene), ElementsAre("a/0", "a/3"));
  ASSERT_EQ(result->left_out.size(), 2u);
  EXPECT_EQ(result->left_out[0].id, "a/1");
  EXPECT_EQ(result->left_out[0].why.where.line, 3u);
  EXPECT_EQ(result->left_out[1].why.what, "index 77 is not that of a vertex");
  EXPECT_EQ(result->left_out[1].why.where.line, 4u);
  EXPECT_THAT((*polygon_groups(result->scene))[0].polygons, ElementsAre(0, 1));
}

// ----------------------------------------------------------------------------------------- written

TEST(WrittenCityJson, ReadsBackAsTheSame) {
  const std::string semantics = R"(, "semantics": {"surfaces": [{"type": "RoofSurface"},
    {"type": "WallSurface"}], "values": [[null, 0, 1, 1, null, 1]]})";
  const std::string loose =
      R"({"type": "MultiSurface", "lod": "1", "boundaries": [[[0,1,2,3],[8,9,10]], [[4,5,6]]]})";
  const Scene scene = scene_of(
      file_of(object("a#1", box(semantics)) + "," + object("b", loose),
              R"("metadata": {"referenceSystem": "EPSG/7415"}, )" + std::string(kTransform)),
      "a.json");
  const auto written = scene_to_text(scene, SceneFormat::kCityJson);
  ASSERT_TRUE(written) << to_string(written.error());
  EXPECT_THAT(written->warnings, IsEmpty());
  const Scene back = scene_of(written->text, "a.city.json");
  expect_same_geometry(back, scene);
  EXPECT_EQ(ids(back), ids(scene));
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    EXPECT_EQ(back.is_two_sided(back.polygons[i]), scene.is_two_sided(scene.polygons[i])) << i;
    EXPECT_EQ(back.polygons[i].holes, scene.polygons[i].holes) << i;
  }
  EXPECT_EQ(scene_to_text(back, SceneFormat::kCityJson)->text, written->text);
  EXPECT_THAT(back.extra, HasSubstr("EPSG/7415"));
  EXPECT_EQ(polygon_groups(back)->size(), polygon_groups(scene)->size());
}

TEST(WrittenCityJson, TurnedSolidsToo) {
  const std::string inwards = R"({"boundaries": [[ [[6,7,2]], [[7,6,5]], [[2,7,5]], [[2,5,6]] ]],
    "type": "Solid", "lod": "1"})";
  const auto read = parse_scene(file_of(object("a", inwards)), "a.json", {});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->warnings.size(), 1u);
  const auto written = scene_to_text(read->scene, SceneFormat::kCityJson);
  ASSERT_TRUE(written);
  EXPECT_EQ(geometry_digest(scene_of(written->text, "a.json")), geometry_digest(read->scene));
}

TEST(WrittenCityJson, SaysWhatIsLost) {
  const Scene scene = scene_of(full_json(), "s.json");
  Scene small = scene;
  small.vertices[7] = {};
  const auto written = scene_to_text(small, SceneFormat::kCityJson);
  ASSERT_TRUE(written) << to_string(written.error());
  EXPECT_THAT(
      written->warnings,
      ElementsAre("3 polygons: the id becomes that of an object, and is read with /0",
                  "1 polygon with one side: the format has them in solids only, and reads "
                  "two sides",
                  "casts of 1 polygon left out", "3 lights left out", "\"extra\" left out"));
  const Scene back = scene_of(written->text, "s.city.json");
  EXPECT_THAT(ids(back), ElementsAre("floor/0", "1/0", "2/0"));
  small.vertices[7] = position("1e600", "0", "1e-600");
  small.vertices[6] = position("1e-600", "0", "1e600");
  const auto too_long = scene_to_text(small, SceneFormat::kCityJson);
  ASSERT_FALSE(too_long);
  EXPECT_EQ(too_long.error().code, ErrorCode::kLimit);
  EXPECT_EQ(too_long.error().where.pointer, "/vertices/6/2");
}

TEST(WrittenCityJson, NamesNeverCollide) {
  const std::string polygons =
      R"({"id": "a", "loop": [0,1,2]}, {"id": "a/0", "loop": [0,1,2]}, {"id": "b/0", "loop": [0,1,2]},
         {"id": "b/1", "loop": [0,1,2]}, {"id": "b", "loop": [0,1,2]}, {"id": "b/3", "loop": [0,1,2]})";
  const Scene scene = scene_of(R"({"format": "gnomon-scene", "version": 1, "two_sided": true,
                   "vertices": [[0,0,0],[0.1,0,0],[0,1,0]], "polygons": [)" +
                                   polygons + "]}",
                               "s.json");
  const auto written = scene_to_text(scene, SceneFormat::kCityJson);
  ASSERT_TRUE(written);
  ReadOptions doubles;
  doubles.numbers = NumberMeaning::kDouble;
  const Scene back = scene_of(written->text, "s.city.json", doubles);
  EXPECT_THAT(ids(back), ElementsAre("a/0", "a/0/0", "b/0", "b/1", "b//0", "b/3/0"));
  EXPECT_EQ(back.vertices[1][0], Number(0.1));
}

// ------------------------------------------------------------------------------------- CityJSONSeq

std::string feature(const std::string& name, const std::string& vertices) {
  return R"({"type":"CityJSONFeature","id":")" + name + R"(","CityObjects":{")" + name +
         R"(":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"1",)" +
         R"("boundaries":[[[0,1,2]]]}]}},"vertices":)" + vertices + "}\n";
}
const std::string kHeader =
    R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.1,0.1,0.1],"translate":[0,0,1]},)"
    R"("CityObjects":{},"vertices":[]})"
    "\n";

TEST(CityJsonSeq, LinesHaveVerticesOfTheirOwn) {
  const std::string text = kHeader + feature("a", "[[0,0,0],[1,0,0],[0,1,0]]") + "\n" +
                           feature("b", "[[5,5,5],[6,5,5],[5,6,5]]");
  for (const char* file : {"a.city.jsonl", "a.jsonl", "a.json", "a"}) {
    const Scene scene = scene_of(text, file);
    EXPECT_THAT(ids(scene), ElementsAre("a/0", "b/0"));
    EXPECT_EQ(scene.vertices[scene.polygons[1].loop[1]], position("0.6", "0.5", "1.5"));
    EXPECT_EQ(scene.name, "a");
  }
}

TEST(CityJsonSeq, IsTheSameWhetherStreamedOrNot) {
  const test::TestDirectory directory;
  std::string text = kHeader;
  for (int i = 0; i < 3000; ++i) {  // more than a window
    text += feature("f" + std::to_string(i), "[[0,0,0],[1,0,0],[0,1," + std::to_string(i) + "]]");
  }
  text.pop_back();
  const auto path = directory.path() / "city.jsonl";
  std::ofstream(path) << text;
  const auto streamed = read_scene(path);
  ASSERT_TRUE(streamed) << to_string(streamed.error());
  const Scene whole = scene_of(text, "city.jsonl");
  expect_same_scene(streamed->scene, whole);
  EXPECT_EQ(streamed->scene.polygons.size(), 3000u);
  std::ofstream(path, std::ios::app) << "\n{\"type\": \"CityJSONFeature\",\n";
  const auto broken = read_scene(path);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().where.line, 3002u);
  EXPECT_EQ(broken.error().what, "the file ends too early");
  std::ofstream(path) << "\n \n";
  EXPECT_EQ(read_scene(path).error().what, "the file is empty");
}

TEST(CityJsonSeq, BadLines) {
  EXPECT_EQ(error_of(feature("a", "[[0,0,0],[1,0,0],[0,1,0]]"), "a.jsonl"),
            "1:9: this is not the type of a CityJSON file @/type");
  EXPECT_EQ(error_of(kHeader + kHeader, "a.jsonl"),
            "2:9: this is not the type of a feature @/type");
  EXPECT_EQ(error_of(kHeader + feature("a", "[[0,0,0],[1,0,0]]"), "a.jsonl"),
            "2:139: index 2 is not that of a vertex @/CityObjects/a/geometry/0/boundaries/0/0/2");
  const std::string good = feature("a", "[[0,0,0],[1,0,0],[0,1,0]]");
  EXPECT_EQ(error_of(kHeader + good + good, "a.jsonl"),
            "3:51: a second city object 'a' @/CityObjects/a");
  EXPECT_THAT(error_of(kHeader + "{\"type\": \xff}\n", "a.jsonl"),
              HasSubstr("2:10: this byte is not valid UTF-8"));
  ReadOptions options;
  options.skip_bad = true;
  const auto result = parse_scene(kHeader + feature("a", "[[0,0,0],[1,0,0]]") + good.substr(0, 40),
                                  "a.jsonl", options);
  EXPECT_FALSE(result);
  const auto left =
      parse_scene(kHeader + feature("b", "[[0,0,0],[1,0,0]]") + good, "a.jsonl", options);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->left_out[0].why.where.line, 2u);
}

}  // namespace
}  // namespace gnomon
