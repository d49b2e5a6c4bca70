// SPDX-License-Identifier: GPL-3.0-or-later
// IDF and epJSON: axes, directions, windows, overhangs and fins at corners worked out by hand, what
// is left out, and where each kind of bad file goes wrong.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "gnomon/scene/digest.h"
#include "gnomon/scene/groups.h"
#include "gnomon/scene/write.h"
#include "scene_testing.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kRelative =
    "GlobalGeometryRules, UpperLeftCorner, Counterclockwise, Relative;\n";
constexpr const char* kWorld = "GlobalGeometryRules, ULC, CCW, World;\n";

std::string zone(const std::string& north, const std::string& origin) {
  return "Zone, Hall, " + north + ", " + origin + ";\n";
}

/// A wall that looks south, 8 wide and 3 high, with x from 0 and y = 0.
std::string south_wall(const std::string& condition = "Outdoors") {
  return "BuildingSurface:Detailed, South, Wall, C, Hall, , " + condition +
         ", , SunExposed, WindExposed, , 4,\n"
         "  0,0,3, 0,0,0, 8,0,0, 8,0,3;\n";
}
constexpr const char* kWindow = "Window, Pane, C, South, , 1, 1, 1, 2, 1;\n";

ReadResult read(const std::string& text, const std::string& file = "a.idf",
                const ReadOptions& options = {}) {
  auto result = parse_scene(text, file, options);
  EXPECT_TRUE(result) << to_string(result.error());
  return result ? *std::move(result) : ReadResult();
}

/// "(1, 0, 2.5)" for each vertex of a loop.
std::vector<std::string> corners(const Scene& scene, const std::vector<VertexId>& loop) {
  std::vector<std::string> all;
  for (const VertexId vertex : loop) {
    const Position& at = scene.vertices[vertex];
    all.push_back("(" + at[0].to_text() + ", " + at[1].to_text() + ", " + at[2].to_text() + ")");
  }
  return all;
}
std::vector<VertexId> loop_of(const Polygon& polygon) {
  return {polygon.loop.begin(), polygon.loop.end()};
}
std::vector<std::string> corners(const Scene& scene, const std::string& id) {
  for (const Polygon& polygon : scene.polygons) {
    if (polygon.id == id) return corners(scene, loop_of(polygon));
  }
  return {"there is no " + id};
}

TEST(EnergyModel, WindowsAreHolesAndPolygonsOfTheirOwn) {
  const ReadResult result =
      read(std::string(kRelative) + zone("0", "10, 20, 0.5") + kWindow + south_wall());
  EXPECT_THAT(result.warnings, IsEmpty());
  const Scene& scene = result.scene;
  EXPECT_EQ(scene.numbers, NumberMeaning::kDecimal);
  ASSERT_EQ(scene.polygons.size(), 2u);
  EXPECT_EQ(scene.polygons[0].id, "Pane");
  EXPECT_THAT(corners(scene, "Pane"),
              ElementsAre("(11, 20, 1.5)", "(13, 20, 1.5)", "(13, 20, 2.5)", "(11, 20, 2.5)"));
  EXPECT_THAT(corners(scene, "South"),
              ElementsAre("(10, 20, 3.5)", "(10, 20, 0.5)", "(18, 20, 0.5)", "(18, 20, 3.5)"));
  ASSERT_EQ(scene.polygons[1].holes.size(), 1u);
  EXPECT_EQ(corners(scene, scene.polygons[1].holes[0]), corners(scene, "Pane"));
  EXPECT_FALSE(scene.is_two_sided(scene.polygons[0]));
  const auto groups = polygon_groups(scene);
  ASSERT_TRUE(groups);
  ASSERT_EQ(groups->size(), 3u);
  EXPECT_EQ((*groups)[0].name, "hall");
  EXPECT_THAT((*groups)[0].polygons, ElementsAre(0, 1));
  EXPECT_EQ((*groups)[1].name, "Window");
}

TEST(EnergyModel, ClockwiseLoopsAreReversedAndEveryCornerMayBeFirst) {
  const std::string head = zone("0", "0, 0, 0");
  const std::string rest = "BuildingSurface:Detailed, South, Wall, C, Hall, , Outdoors, , , , , 4,";
  struct Way {
    const char* rules;
    const char* vertices;
  };
  for (const Way& way : {Way{"LowerLeftCorner, Counterclockwise", "0,0,0, 8,0,0, 8,0,3, 0,0,3;\n"},
                         Way{"LRC, CCW", "8,0,0, 8,0,3, 0,0,3, 0,0,0;\n"},
                         Way{"UpperRightCorner, ccw", "8,0,3, 0,0,3, 0,0,0, 8,0,0;\n"},
                         Way{"ULC, Clockwise", "0,0,3, 8,0,3, 8,0,0, 0,0,0;\n"},
                         Way{"lowerleftcorner, CW", "0,0,0, 0,0,3, 8,0,3, 8,0,0;\n"},
                         Way{"URC, clockwise", "8,0,3, 8,0,0, 0,0,0, 0,0,3;\n"},
                         Way{"LRC, CW", "8,0,0, 0,0,0, 0,0,3, 8,0,3;\n"}}) {
    const Scene scene = read("GlobalGeometryRules, " + std::string(way.rules) + ", Relative;\n" +
                             head + rest + way.vertices + kWindow)
                            .scene;
    EXPECT_THAT(corners(scene, "Pane"),
                ElementsAre("(1, 0, 1)", "(3, 0, 1)", "(3, 0, 2)", "(1, 0, 2)"))
        << way.rules;
    // Outwards is south: the vertex behind (0, 0, 3) is (0, 0, 0).
    const auto loop = corners(scene, "South");
    const auto top = std::find(loop.begin(), loop.end(), "(0, 0, 3)") - loop.begin();
    EXPECT_EQ(loop[static_cast<std::size_t>(top + 1) % 4], "(0, 0, 0)") << way.rules;
  }
}

TEST(EnergyModel, RightAnglesTurnExactly) {
  const std::string building = "Building, B, 90;\n";
  const Scene scene = read(building + kRelative + zone("-180", "1, 0, 0") + south_wall()).scene;
  // By the zone: (x, 0) to (-x, 0) + (1, 0); by the building, clockwise: (x, y) to (y, -x).
  EXPECT_THAT(corners(scene, "South"),
              ElementsAre("(0, -1, 3)", "(0, -1, 0)", "(0, 7, 0)", "(0, 7, 3)"));
  const ReadResult world = read(building + kWorld + zone("45", "7, 7, 7") + south_wall());
  EXPECT_THAT(corners(world.scene, "South"),
              ElementsAre("(0, 0, 3)", "(0, 0, 0)", "(8, 0, 0)", "(8, 0, 3)"));
  EXPECT_THAT(world.warnings,
              ElementsAre("the building's north axis of 90 degrees counts for nothing where "
                          "coordinates are those of the world"));
}

TEST(EnergyModel, OtherAnglesKeepPlanesAndAreTold) {
  const ReadResult result = read("Building, B, 30;\n" + std::string(kRelative) +
                                 zone("0", "0, 0, 0") + south_wall() + kWindow);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_THAT(result.warnings[0], HasSubstr("the building is turned by 30 degrees"));
  const Scene& scene = result.scene;
  EXPECT_THAT(corners(scene, "South")[2], "(6.928203230272, -4, 0)");
  EXPECT_THAT(corners(scene, "Pane"),
              ElementsAre("(0.866025403784, -0.5, 1)", "(2.598076211352, -1.5, 1)",
                          "(2.598076211352, -1.5, 2)", "(0.866025403784, -0.5, 2)"));
  EXPECT_THAT(scene.extra, HasSubstr(R"("north_axis":30,"turned":true)"));
}

TEST(EnergyModel, AxesMayBeKept) {
  ReadOptions options;
  options.keep_axes = true;
  const std::string text =
      "Building, B, 30;\n" + std::string(kRelative) + zone("0", "0, 0, 0") + south_wall();
  const ReadResult kept = read(text, "a.idf", options);
  EXPECT_THAT(corners(kept.scene, "South")[2], "(8, 0, 0)");
  EXPECT_THAT(kept.scene.extra, HasSubstr(R"("north_axis":30,"turned":false)"));
  EXPECT_THAT(kept.warnings, ElementsAre(HasSubstr("the sun has to be turned")));
  const ReadResult turned =
      read(text + "Shading:Site:Detailed, Tree, , 3, 0,-9,0, 1,-9,0, 0,-9,5;\n", "a.idf", options);
  EXPECT_THAT(turned.scene.extra, HasSubstr(R"("turned":true)"));
  EXPECT_THAT(corners(turned.scene, "Tree")[0], "(0, -9, 0)");
}

TEST(EnergyModel, OverhangsAndFinsStandWhereTheReferenceSays) {
  const Scene scene = read(std::string(kWorld) + south_wall() + kWindow +
                           "Shading:Overhang, Over, Pane, 0.5, 90, 0.25, 0.75, 1;\n"
                           "Shading:Overhang, Up, Pane, 0.5, 0, 0, 0, 0.1;\n"
                           "Shading:Overhang:Projection, Half, Pane, 0, , 0, 0, 0.5;\n"
                           "Shading:Fin, Side, Pane, 0.1, 0.2, 0.3, 90, 0.5, 0.4, 0, 0, , 0.25;\n"
                           "Shading:Fin:Projection, Left, pane, 0, 0, 0, , 0.5, 0, 0, 0, , 0;\n")
                          .scene;
  EXPECT_THAT(corners(scene, "Over"), ElementsAre("(0.75, 0, 2.5)", "(3.75, 0, 2.5)",
                                                  "(3.75, -1, 2.5)", "(0.75, -1, 2.5)"));
  EXPECT_THAT(corners(scene, "Up"),
              ElementsAre("(1, 0, 2.5)", "(3, 0, 2.5)", "(3, 0, 2.6)", "(1, 0, 2.6)"));
  EXPECT_THAT(corners(scene, "Half"),
              ElementsAre("(1, 0, 2)", "(3, 0, 2)", "(3, -0.5, 2)", "(1, -0.5, 2)"));
  EXPECT_THAT(corners(scene, "Side Left"), ElementsAre("(0.9, 0, 0.7)", "(0.9, -0.5, 0.7)",
                                                       "(0.9, -0.5, 2.2)", "(0.9, 0, 2.2)"));
  EXPECT_THAT(corners(scene, "Side Right"),
              ElementsAre("(3.4, 0, 1)", "(3.4, -0.25, 1)", "(3.4, -0.25, 2)", "(3.4, 0, 2)"));
  EXPECT_THAT(corners(scene, "Left Left"),
              ElementsAre("(1, 0, 1)", "(1, -1, 1)", "(1, -1, 2)", "(1, 0, 2)"));
  EXPECT_EQ(corners(scene, "Left Right")[0], "there is no Left Right");
  EXPECT_TRUE(scene.is_two_sided(scene.polygons[2]));
}

TEST(EnergyModel, AWindowsPlaceIsExactWhereTheWallsDirectionIsDecimal) {
  const auto wall = [](const std::string& vertices) {
    return std::string(kWorld) +
           "BuildingSurface:Detailed, South, Wall, C, Hall, , Outdoors, , , , , 4, " + vertices;
  };
  const ReadResult exact =
      read(wall("0,0,3, 0,0,0, 6,8,0, 6,8,3;\n") + "Window, Pane, C, South, , , 5, 1, 2.5, 1;\n");
  EXPECT_THAT(exact.warnings, IsEmpty());
  EXPECT_THAT(corners(exact.scene, "Pane"),
              ElementsAre("(3, 4, 1)", "(4.5, 6, 1)", "(4.5, 6, 2)", "(3, 4, 2)"));
  const ReadResult rounded =
      read(wall("0,0,3, 0,0,0, 1,1,0, 1,1,3;\n") + "Door, Gate, C, South, , 0.5, 0, 0.25, 2;\n");
  EXPECT_THAT(rounded.warnings, ElementsAre(HasSubstr("1 surface is placed by lengths along")));
  // In the plane of its wall all the same.
  for (const Position& at : rounded.scene.vertices) EXPECT_EQ(at[0], at[1]);
  EXPECT_NEAR(rounded.scene.vertices[5][0].nearest(), 0.75 / std::sqrt(2.0), 1e-15);
  // A tilted roof of 3, 4, 5: up is (0, 0.8, 0.6).
  const ReadResult roof =
      read(wall("0,4,3, 0,0,0, 2,0,0, 2,4,3;\n") + "Window, Sky, C, South, , , 0.5, 1, 1, 2;\n");
  EXPECT_THAT(corners(roof.scene, "Sky"), ElementsAre("(0.5, 0.8, 0.6)", "(1.5, 0.8, 0.6)",
                                                      "(1.5, 2.4, 1.8)", "(0.5, 2.4, 1.8)"));
}

TEST(EnergyModel, DetachedShadingAndSurfacesByLengthAndHeight) {
  const Scene scene = read("Building, B, 90;\n" + std::string(kRelative) + zone("0", "1, 2, 3") +
                           "Shading:Site, Far, 180, 90, -5, -20, 0, 10, 7;\n"
                           "Shading:Building, Near, 180, 90, 0, -5, 0, 4, 2;\n"
                           "Shading:Building:Detailed, Tilted, Sched, 3, 0,0,0, 1,0,0, 0,1,1;\n"
                           "Wall:Exterior, East, C, Hall, , 90, , 4, 0, 0, 3, 2.5;\n"
                           "Roof, Top, C, Hall, , 180, , 0, 0, 2.5, 4, 3;\n"
                           "Window, Pane, C, East, , , 1, 1, 1, 1;\n")
                          .scene;
  EXPECT_THAT(corners(scene, "Far"),
              ElementsAre("(-5, -20, 0)", "(5, -20, 0)", "(5, -20, 7)", "(-5, -20, 7)"));
  EXPECT_THAT(corners(scene, "Near"),
              ElementsAre("(-5, 0, 0)", "(-5, -4, 0)", "(-5, -4, 2)", "(-5, 0, 2)"));
  EXPECT_THAT(corners(scene, "Tilted"), ElementsAre("(0, 0, 0)", "(0, -1, 0)", "(1, 0, 1)"));
  // (x, y) + (1, 2), then to (y, -x).
  EXPECT_THAT(corners(scene, "East"),
              ElementsAre("(2, -5, 3)", "(5, -5, 3)", "(5, -5, 5.5)", "(2, -5, 5.5)"));
  EXPECT_THAT(corners(scene, "Pane"),
              ElementsAre("(3, -5, 4)", "(4, -5, 4)", "(4, -5, 5)", "(3, -5, 5)"));
  EXPECT_THAT(corners(scene, "Top"),
              ElementsAre("(2, -1, 5.5)", "(2, -5, 5.5)", "(5, -5, 5.5)", "(5, -1, 5.5)"));
}

TEST(EnergyModel, WhatIsLeftOutIsSaid) {
  const ReadResult result = read(
      std::string(kWorld) + south_wall("Zone") + "Door:Interzone, D, C, South, X, 1, 0,0,1,2;\n" +
      "Shading:Overhang, Over, D, 0, 90, 0, 0, 1;\n"
      "Wall:Adiabatic, Inner, C, Hall, , 0, 90, 0, 0, 0, 1, 1;\n"
      "Shading:Site:Detailed, T1, Leaves, 3, 0,-9,0, 1,-9,0, 0,-9,5;\n"
      "Shading:Site:Detailed, T2, Leaves, , 0,-9,0, 1,-9,0, 0,-9,5,,,;\n"
      "Shading:Zone:Detailed, T3, South, Old, 3, 0,-8,0, 1,-8,0, 0,-8,5;\n"
      "WindowProperty:FrameAndDivider, Frame, 0.05;\n"
      "Building, B, 0, City, 0.04, 0.4, MinimalShadowing;\n");
  EXPECT_THAT(
      result.warnings,
      ElementsAre("4 interior surfaces left out: what does not face the outdoors neither casts nor "
                  "receives",
                  "3 shading surfaces with a transmittance schedule (Leaves, Old) count as opaque",
                  HasSubstr("frames, dividers and reveals"), HasSubstr("MinimalShadowing")));
  EXPECT_EQ(result.scene.polygons.size(), 3u);
}

TEST(EnergyModel, FieldsOfOlderVersions) {
  const std::string old =
      "BuildingSurface:Detailed, South, Wall, C, Hall, Outdoors, , SunExposed, WindExposed, , 4, "
      "0,0,3, 0,0,0, 8,0,0, 8,0,3;\n";
  for (const std::string& version : {std::string("Version, 9.5;\n"), std::string()}) {
    const Scene scene = read(version + kWorld + old + kWindow).scene;
    EXPECT_EQ(scene.polygons.size(), 2u) << version;
  }
  const std::string before_9 =
      "Window, Pane, C, South, , Frame, 1, 1, 1, 2, 1;\n"
      "FenestrationSurface:Detailed, Pane2, Window, C, South, , , , , 1, 3, "
      "5,0,1, 6,0,1, 5,0,2;\n";
  for (const std::string& version : {std::string("Version, 8.9.0;\n"), std::string()}) {
    const Scene scene = read(before_9 + kWorld + old + version).scene;
    EXPECT_THAT(corners(scene, "Pane"),
                ElementsAre("(1, 0, 1)", "(3, 0, 1)", "(3, 0, 2)", "(1, 0, 2)"));
    EXPECT_EQ(scene.polygons.size(), 3u);
  }
}

TEST(EnergyModel, EpJsonIsTheSameModel) {
  const std::string idf =
      "Version, 23.1;\nSite:Location, Here, 39.75, -104.9, -7, 1609.;\n"
      "Building, B, 30;\n" +
      std::string(kRelative) + zone("0", "1, 2, 0") + south_wall() + kWindow +
      "Shading:Site:Detailed, Tree, Leaves, 3, 0,-9,0, 1,-9,0, 0,-9,5.25;\n";
  const std::string epjson = R"({
    "Version": {"Version 1": {"version_identifier": "23.1"}},
    "Site:Location": {"Here": {"latitude": 39.75, "longitude": -104.9, "time_zone": -7,
                               "elevation": 1609}},
    "Building": {"B": {"north_axis": 30}},
    "GlobalGeometryRules": {"Rules 1": {"starting_vertex_position": "UpperLeftCorner",
      "vertex_entry_direction": "Counterclockwise", "coordinate_system": "Relative"}},
    "Zone": {"Hall": {"x_origin": 1, "y_origin": 2.0}},
    "BuildingSurface:Detailed": {"South": {"surface_type": "Wall", "construction_name": "C",
      "zone_name": "Hall", "outside_boundary_condition": "Outdoors", "number_of_vertices": 4,
      "vertices": [
        {"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 3},
        {"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 0},
        {"vertex_x_coordinate": 8, "vertex_y_coordinate": 0, "vertex_z_coordinate": 0},
        {"vertex_x_coordinate": 8, "vertex_y_coordinate": 0, "vertex_z_coordinate": 3}]}},
    "Window": {"Pane": {"building_surface_name": "SOUTH", "starting_x_coordinate": 1,
      "starting_z_coordinate": 1, "length": 2, "height": 1}},
    "Shading:Site:Detailed": {"Tree": {"transmittance_schedule_name": "Leaves", "vertices": [
        {"vertex_x_coordinate": 0, "vertex_y_coordinate": -9, "vertex_z_coordinate": 0},
        {"vertex_x_coordinate": 1, "vertex_y_coordinate": -9, "vertex_z_coordinate": 0},
        {"vertex_x_coordinate": 0, "vertex_y_coordinate": -9, "vertex_z_coordinate": 5.25}]}},
    "Lights": {"L": {"zone": ["ignored"]}}})";
  const ReadResult a = read(idf), b = read(epjson, "a.epJSON"), c = read(epjson, "a.json");
  EXPECT_EQ(geometry_digest(a.scene), geometry_digest(b.scene));
  EXPECT_EQ(geometry_digest(a.scene), geometry_digest(c.scene));
  EXPECT_EQ(a.scene.extra, b.scene.extra);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_THAT(a.scene.extra, HasSubstr(R"("location":{"name":"Here","latitude":39.75,)"
                                       R"("longitude":-104.9,"time_zone":-7,"elevation":1609})"));
  const auto json = scene_to_text(a.scene, SceneFormat::kJson);
  ASSERT_TRUE(json);
  expect_same_scene(scene_of(json->text, "back.json"), a.scene);
  EXPECT_EQ(scene_to_text(a.scene, SceneFormat::kIdf).error().code, ErrorCode::kUsage);
}

TEST(EnergyModel, EpJsonWindowsHaveNumberedVertices) {
  const std::string epjson = R"({"GlobalGeometryRules": {"R": {"starting_vertex_position": "ULC",
      "vertex_entry_direction": "CCW", "coordinate_system": "World"}},
    "Wall:Detailed": {"W": {"outside_boundary_condition": "Outdoors", "vertices": [
        {"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 3},
        {"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 0},
        {"vertex_x_coordinate": 8, "vertex_y_coordinate": 0, "vertex_z_coordinate": 0}]}},
    "FenestrationSurface:Detailed": {"P": {"surface_type": "window", "building_surface_name": "w",
      "vertex_1_x_coordinate": 1, "vertex_1_y_coordinate": 0, "vertex_1_z_coordinate": 1,
      "vertex_2_x_coordinate": 1, "vertex_2_y_coordinate": 0, "vertex_2_z_coordinate": 0.5,
      "vertex_3_x_coordinate": 2, "vertex_3_y_coordinate": 0, "vertex_3_z_coordinate": 0.5}}})";
  const Scene scene = read(epjson, "a.json").scene;
  EXPECT_THAT(corners(scene, "P"), ElementsAre("(1, 0, 0.5)", "(2, 0, 0.5)", "(1, 0, 1)"));
  EXPECT_EQ(scene.polygons[0].holes.size(), 1u);
}

TEST(EnergyModel, ContentTellsTheFormat) {
  const std::string text = "! a house\n\n  Version , 9.5;\n" + std::string(kWorld) + south_wall();
  EXPECT_EQ(read(text, "house.txt").scene.polygons.size(), 1u);
  EXPECT_EQ(format_by_content(text), SceneFormat::kIdf);
  EXPECT_EQ(format_by_content("{\"GlobalGeometryRules\" : {}}"), SceneFormat::kEpJson);
}

TEST(EnergyModel, BadFilesEndInOneErrorAtItsPlace) {
  const std::string world = kWorld;
  const auto error = [&](const std::string& text) { return error_of(text, "a.idf"); };
  EXPECT_EQ(error(south_wall()), "1:1: there is no GlobalGeometryRules");
  EXPECT_EQ(error(world + world), "2:1: a second GlobalGeometryRules");
  EXPECT_EQ(error("GlobalGeometryRules, Top, CCW, World;"),
            "1:22: a starting vertex position 'Top'");
  EXPECT_EQ(error("GlobalGeometryRules, ULC, Left, World;"),
            "1:27: a vertex entry direction 'Left'");
  EXPECT_EQ(error("GlobalGeometryRules, ULC, CCW, Moon;"), "1:32: a coordinate system 'Moon'");
  EXPECT_EQ(error(world + "Zone, Hall, 0, 0"), "2:17: the file ends inside an object");
  EXPECT_EQ(error(world + "Zone, Hall\n 0, 0;"),
            "2:11: no comma and no semicolon behind this field");
  EXPECT_EQ(error(world + "##include x\n"), "2:1: a command of EPMacro");
  EXPECT_EQ(error(world + "Zone, Hall, north, 0, 0;"),
            "2:13: direction_of_relative_north: 'north' is not a number");
  EXPECT_EQ(error(kRelative + south_wall()), "2:1: there is no zone 'Hall'");
  EXPECT_EQ(error(world + south_wall() + south_wall()), "4:1: a second surface 'South'");
  EXPECT_EQ(error(world + kWindow), "2:1: there is no surface 'South'");
  EXPECT_EQ(error(world + "Shading:Fin, F, Pane;"), "2:1: there is no window or door 'Pane'");
  EXPECT_EQ(error(world + south_wall("")), "2:1: 'South' has no outside boundary condition");
  const auto shade = [&](const std::string& fields) {
    return error(world + "Shading:Site:Detailed, T, , " + fields + ";");
  };
  EXPECT_EQ(shade("4, 0,0,0, 1,0,0, 0,1,0"),
            "2:29: 'T' announces 4 vertices and has 9 coordinates");
  EXPECT_EQ(shade("99999999999999999999, 0,0,0"),
            "2:29: 'T' announces 99999999999999999999 vertices and has 3 coordinates");
  EXPECT_EQ(shade("-3, 0,0,0"), "2:29: '-3' vertices");
  EXPECT_EQ(shade("1e999999999, 0,0,0").substr(0, 5), "2:29:");
  EXPECT_EQ(shade(", 0,0,0, 1,0,0, 0,1"), "2:1: 'T' has 8 coordinates");
  EXPECT_EQ(shade("2, 0,0,0, 1,0,0"), "2:1: 'T' has 2 vertices");
  EXPECT_EQ(shade("3, 0,0,0, 1,x,0, 0,1,0"), "2:41: 'x' is not a number");
  EXPECT_EQ(shade("3, 0,0,0, 1,,0, 0,1,0"), "2:41: a coordinate is blank");
  EXPECT_EQ(error(world + "GeometryTransform, XY, 1, 2;"),
            "2:1: GeometryTransform is not carried out here");
  EXPECT_EQ(error(world + "Compliance:Building, 90;"),
            "2:1: Compliance:Building is not carried out here");
  EXPECT_EQ(error(world + "Compliance:Building, 0;"), "ok");
  EXPECT_EQ(error_of(R"({"GlobalGeometryRules": {"R": [1]}})", "a.epjson"),
            "1:31: found an array @/GlobalGeometryRules/R");
  EXPECT_THAT(error_of(R"({"GlobalGeometryRules": {"R": )", "a.epjson"),
              HasSubstr("the file ends too early"));
}

TEST(EnergyModel, SkipBadLeavesSurfacesOut) {
  ReadOptions options;
  options.skip_bad = true;
  const ReadResult result =
      read(std::string(kWorld) + south_wall() + "Window, Lost, C, North, , 1, 1, 1, 2, 1;\n" +
               "Shading:Site:Detailed, T, , 3, 0,0,0, 1,x,0, 0,1,0;\n" + kWindow,
           "a.idf", options);
  EXPECT_EQ(result.scene.polygons.size(), 2u);
  ASSERT_EQ(result.left_out.size(), 2u);
  EXPECT_EQ(result.left_out[0].id, "Lost");
  EXPECT_EQ(result.left_out[0].why.where.line, 4u);
  EXPECT_EQ(result.left_out[1].id, "T");
}

TEST(EnergyModel, NamesThatAreNoIds) {
  const Scene scene =
      read(std::string(kWorld) + "Shading:Site:Detailed, caf\xe9 #1, , 3, 0,0,0, 1,0,0, 0,1,0;")
          .scene;
  EXPECT_EQ(scene.polygons[0].id, "caf%E9 %231");
}

}  // namespace
}  // namespace gnomon
