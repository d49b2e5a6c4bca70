// SPDX-License-Identifier: GPL-3.0-or-later
// HBJSON and gbXML: units, sides, what is left out, windows in and before their walls, and where
// each kind of bad file goes wrong.
#include <gmock/gmock.h>

#include "gnomon/scene/groups.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/repair.h"
#include "gnomon/scene/write.h"
#include "scene_testing.h"
#include "shown_scene.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// ------------------------------------------------------------------------------------------ HBJSON

std::string face3d(const std::string& boundary, const std::string& holes = "null") {
  return R"("geometry": {"type": "Face3D", "boundary": )" + boundary + R"(, "holes": )" + holes +
         "}";
}

/// A south wall of 8 by 3 in a room, with a window at that y.
std::string hbjson(const std::string& window_y, const std::string& units = "Meters",
                   const std::string& more = "") {
  return R"({"type": "Model", "identifier": "house", "units": ")" + units + R"(", "tolerance": 0.01,
 "properties": {"type": "ModelProperties"}, "rooms": [{"type": "Room", "identifier": "hall", "faces": [
  {"type": "Face", "identifier": "south", "face_type": "Wall", "boundary_condition": {"type": "Outdoors"},
   )" + face3d("[[0,0,0],[8,0,0],[8,0,3],[0,0,3]]") +
         R"(, "apertures": [{"type": "Aperture", "identifier": "pane", "boundary_condition": {"type": "Outdoors"},
   )" +
         face3d("[[1," + window_y + ",1],[3," + window_y + ",1],[3," + window_y + ",2],[1," +
                window_y + ",2]]") +
         R"(, "indoor_shades": [{"identifier": "curtain"}],
    "outdoor_shades": [{"type": "Shade", "identifier": "ledge", )" +
         face3d("[[0,0,2.5],[8,0,2.5],[8,-0.75,2.5],[0,-0.75,2.5]]") + R"(}]}]},
  {"type": "Face", "identifier": "inner", "face_type": "Wall", "boundary_condition": {"type": "Surface"},
   )" + face3d("[[0,9,0],[8,9,0],[8,9,3],[0,9,3]]") +
         R"(, "doors": [{"identifier": "d"}]}]}])" + more + "}";
}

TEST(HbJson, RoomsShadesAndWhatIsLeftOut) {
  const ReadResult result = read_text(hbjson("0"), "a.hbjson");
  const Scene& scene = result.scene;
  EXPECT_EQ(scene.numbers, NumberMeaning::kDecimal);
  EXPECT_THAT(ids_of(scene), ElementsAre("south", "pane", "ledge"));
  EXPECT_FALSE(scene.is_two_sided(scene.polygons[1]));
  EXPECT_TRUE(scene.is_two_sided(scene.polygons[2]));
  EXPECT_THAT(scene.polygons[0].holes, IsEmpty());
  EXPECT_EQ(loop_of(scene, "pane"), "(1, 0, 1) (3, 0, 1) (3, 0, 2) (1, 0, 2)");
  EXPECT_THAT(result.warnings,
              ElementsAre(HasSubstr("2 interior surfaces left out"), "1 indoor shade left out"));
  const auto groups = polygon_groups(scene);
  ASSERT_TRUE(groups);
  ASSERT_EQ(groups->size(), 4u);
  EXPECT_EQ((*groups)[0].name, "hall");
  EXPECT_THAT((*groups)[0].polygons, ElementsAre(0, 1));
  EXPECT_THAT(scene.extra, HasSubstr(R"("honeybee":{"units":"Meters","tolerance":0.01,)"));
}

TEST(HbJson, UnitsAreExactDecimals) {
  EXPECT_EQ(loop_of(read_text(hbjson("0", "Feet"), "a.hbjson").scene, "south"),
            "(0, 0, 0) (2.4384, 0, 0) (2.4384, 0, 0.9144) (0, 0, 0.9144)");
  EXPECT_EQ(loop_of(read_text(hbjson("0", "Millimeters"), "a.hbjson").scene, "south"),
            "(0, 0, 0) (0.008, 0, 0) (0.008, 0, 0.003) (0, 0, 0.003)");
  EXPECT_THAT(error_of(hbjson("0", "Cubits"), "a.hbjson"), HasSubstr("units 'Cubits' @/units"));
}

TEST(HbJson, WindowsAHairBeforeTheWallAreToldOfAndPutIntoIt) {
  ReadResult result = read_text(hbjson("-0.004"), "a.hbjson");
  EXPECT_THAT(result.warnings.back(),
              "1 of 1 aperture or door not exactly in the plane of the face, by up to 0.004 m (the "
              "model's tolerance is 0.01 m): what is before the face shades it; 'gnomon convert "
              "--snap 0.01 --parent' puts them into it");
  Scene& scene = result.scene;
  const auto snapped = snap_scene(scene, mpq_class(1, 100));
  ASSERT_TRUE(snapped) << to_string(snapped.error());
  EXPECT_EQ(snapped->pairs_left, 0u);
  const auto parents = make_holes_of_windows(scene);
  ASSERT_TRUE(parents);
  EXPECT_THAT(parents->windows, ElementsAre("pane"));
  EXPECT_THAT(parents->walls, ElementsAre("south"));
  ASSERT_EQ(scene.polygons[0].holes.size(), 1u);
}

TEST(HbJson, LooseThingsHaveTwoSides) {
  const std::string more =
      R"(, "orphaned_faces": [{"identifier": "fence", )" +
      face3d("[[0,-5,0],[9,-5,0],[9,-5,2],[0,-5,2]]", "[[[1,-5,1],[2,-5,1],[2,-5,1.5]]]") +
      R"(}], "orphaned_shades": [{"identifier": "tree", "properties": {"energy": {"transmittance_schedule": {}}}, )" +
      face3d("[[0,-6,0],[9,-6,0],[9,-6,2]]") +
      R"(}], "shade_meshes": [{"type": "ShadeMesh", "identifier": "hill", "geometry": {"type": "Mesh3D",
        "vertices": [[0,20,0],[1,20,0],[1,21,0],[0,21,0],[2,20,1]], "faces": [[0,1,2,3],[1,4,2]]}}])";
  const ReadResult result = read_text(hbjson("0", "Meters", more), "model.json");
  const Scene& scene = result.scene;
  EXPECT_THAT(ids_of(scene),
              ElementsAre("south", "pane", "ledge", "fence", "tree", "hill/0", "hill/1"));
  EXPECT_EQ(scene.polygons[3].holes.size(), 1u);
  for (std::size_t i = 3; i < scene.polygons.size(); ++i) {
    EXPECT_TRUE(scene.is_two_sided(scene.polygons[i]));
  }
  EXPECT_THAT(result.warnings.back(), "1 shade with a transmittance schedule counts as opaque");
}

TEST(HbJson, ErrorsNameTheirPlace) {
  const std::string good = hbjson("0");
  const auto with = [&](const std::string& a, const std::string& b) {
    std::string text = good;
    const std::size_t at = text.find(a);
    EXPECT_NE(at, std::string::npos) << a;
    return text.replace(at, a.size(), b);
  };
  const auto error = [](const std::string& text) { return error_of(text, "a.hbjson"); };
  EXPECT_THAT(error(with("[8,0,0]", "[8,0]")),
              HasSubstr("a point of 2 numbers @/rooms/0/faces/0/geometry/boundary/1"));
  EXPECT_THAT(error(with("[[0,0,0],[8,0,0],[8,0,3],[0,0,3]]", "[[0,0,0],[8,0,0]]")),
              HasSubstr("a loop of 2 vertices @/rooms/0/faces/0/geometry/boundary"));
  EXPECT_THAT(error(with("\"south\"", "17")), HasSubstr("found a number"));
  EXPECT_THAT(error(with("\"pane\"", "\"south\"")),
              HasSubstr("a second surface 'south' @/rooms/0/faces/0/apertures/0"));
  EXPECT_THAT(error(with("\"type\": \"Model\"", "\"type\": \"Room\"")),
              HasSubstr("this is no Model, but 'Room' @/type"));
  EXPECT_THAT(error(with("\"identifier\": \"house\"", "\"buildings\": []")),
              HasSubstr("a model of dragonfly"));
  EXPECT_THAT(error(with("\"rooms\": [", "\"rooms\": 7, \"x\": [")),
              HasSubstr("found a number @/rooms"));
  EXPECT_THAT(error(good.substr(0, 500)), HasSubstr(": "));
  EXPECT_THAT(error_of("", "a.hbjson"), HasSubstr("empty"));
  // Left out instead.
  ReadOptions options;
  options.skip_bad = true;
  const ReadResult result = read_text(with("[8,0,0]", "[8,0]"), "a.hbjson", options);
  EXPECT_THAT(ids_of(result.scene), ElementsAre("pane", "ledge"));
  ASSERT_EQ(result.left_out.size(), 1u);
  EXPECT_EQ(result.left_out[0].id, "south");
  EXPECT_THAT(result.scene.extra, HasSubstr(R"("hall":["pane"])"));
}

// ------------------------------------------------------------------------------------------- gbXML

std::string poly_loop(const std::string& corners) {
  std::string text = "<PlanarGeometry><PolyLoop>";
  std::size_t at = 0;
  while (at < corners.size()) {
    const std::size_t end = std::min(corners.find(';', at), corners.size());
    text += "<CartesianPoint>";
    for (std::size_t i = at; i < end;) {
      const std::size_t comma = std::min(corners.find(',', i), end);
      text += "<Coordinate> " + corners.substr(i, comma - i) + " </Coordinate>";
      i = comma + 1;
    }
    text += "</CartesianPoint>\n";
    at = end + 1;
  }
  return text + "</PolyLoop></PlanarGeometry>";
}

std::string gbxml(const std::string& surfaces, const std::string& unit = "Feet") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gbXML lengthUnit=\"" + unit +
         "\" version=\"6.01\" xmlns=\"http://www.gbxml.org/schema\">\n<Campus id=\"c\">\n" +
         surfaces + "</Campus>\n</gbXML>\n";
}

const std::string kWall =
    "<Surface id=\"w\" surfaceType=\"ExteriorWall\">\n"
    "<AdjacentSpaceId spaceIdRef=\"hall\"/>\n" +
    poly_loop("0,0,0;10,0,0;10,0,10;0,0,10") + "<Opening id=\"o\" openingType=\"FixedWindow\">\n" +
    poly_loop("1,0,1;2,0,1;2,0,2;1,0,2") + "</Opening></Surface>\n";

TEST(GbXml, OpeningsAreHolesAndPolygons) {
  const ReadResult result = read_text(gbxml(kWall +
                                            "<Surface id=\"i\" surfaceType=\"InteriorWall\"/>\n"
                                            "<Surface id=\"a\" surfaceType=\"Air\"/>\n"
                                            "<Surface id=\"s\" surfaceType=\"Shade\">" +
                                            poly_loop("0,-1,0;1,-1,0;1,-1,1") + "</Surface>\n"),
                                      "a.xml");
  const Scene& scene = result.scene;
  EXPECT_EQ(scene.numbers, NumberMeaning::kDecimal);
  EXPECT_THAT(ids_of(scene), ElementsAre("w", "o", "s"));
  EXPECT_EQ(loop_of(scene, "w"), "(0, 0, 0) (3.048, 0, 0) (3.048, 0, 3.048) (0, 0, 3.048)");
  ASSERT_EQ(scene.polygons[0].holes.size(), 1u);
  EXPECT_EQ(shown(scene, scene.polygons[0].holes[0]), loop_of(scene, "o"));
  EXPECT_FALSE(scene.is_two_sided(scene.polygons[0]));
  EXPECT_TRUE(scene.is_two_sided(scene.polygons[2]));
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("1 interior surface left out"),
                                           HasSubstr("1 surface of air left out")));
  EXPECT_THAT(scene.extra, HasSubstr(R"("groups":{"hall":["w","o"],"ExteriorWall":["w"])"));
}

/// A wall of 10 by 10 with openings o0, o1, ...
std::string wall_with(const std::vector<std::string>& openings) {
  std::string text = "<Surface id=\"w\" surfaceType=\"ExteriorWall\">\n" +
                     poly_loop("0,0,0;10,0,0;10,0,10;0,0,10");
  for (std::size_t i = 0; i < openings.size(); ++i) {
    text += "<Opening id=\"o" + std::to_string(i) + "\">" + poly_loop(openings[i]) + "</Opening>\n";
  }
  return gbxml(text + "</Surface>\n", "Meters");
}

/// As programs write them that round: a door whose sill is on the wall's edge, a window beside the
/// wall's plane, one that reaches out of the wall, one over another.
TEST(GbXml, OpeningsThatCannotBeHolesLieOnTheirSurface) {
  const std::string door = "1,0.0000002,0;2,0.0000002,0;2,0.0000002,2;1,0.0000002,2";
  const std::string window = "4,0.0000001,1;5,0.0000001,1;5,0.0000001,2;4,0.0000001,2";
  const ReadResult bent = read_text(wall_with({door, window}), "a.xml");
  ASSERT_EQ(bent.scene.polygons.size(), 3u);
  ASSERT_EQ(bent.scene.polygons[0].holes.size(), 1u);
  EXPECT_EQ(shown(bent.scene, bent.scene.polygons[0].holes[0]), loop_of(bent.scene, "o1"));
  EXPECT_TRUE(prepare(bent.scene));
  EXPECT_THAT(
      bent.warnings,
      ElementsAre(HasSubstr("1 of 2 openings not exactly in the plane of the surface, by up to "
                            "1e-07 m: the surface around them"),
                  HasSubstr("1 of 2 openings not cut out: they cross or touch the edge of their "
                            "surface or one another, and lie on it, up to 2e-07 m before or "
                            "behind it: 'gnomon convert --snap 1e-06 --parent' can put them")));
  const std::string outside = "9,0,1;11,0,1;11,0,2;9,0,2";
  const std::string first = "1,0,1;3,0,1;3,0,3;1,0,3", second = "2,0,2;4,0,2;4,0,4;2,0,4";
  const ReadResult flat = read_text(wall_with({outside, first, second}), "a.xml");
  ASSERT_EQ(flat.scene.polygons[0].holes.size(), 1u);
  EXPECT_EQ(shown(flat.scene, flat.scene.polygons[0].holes[0]), loop_of(flat.scene, "o1"));
  EXPECT_TRUE(prepare(flat.scene));
  EXPECT_THAT(flat.warnings, ElementsAre(HasSubstr("2 of 3 openings not cut out")));
  EXPECT_THAT(flat.warnings[0], Not(HasSubstr("--snap")));
  // A door exactly on the edge is a notch.
  const ReadResult exact = read_text(wall_with({"1,0,0;2,0,0;2,0,2;1,0,2"}), "a.xml");
  EXPECT_EQ(exact.scene.polygons[0].holes.size(), 1u);
  EXPECT_THAT(exact.warnings, IsEmpty());
  // A wall that cannot be used is told of, whatever is in it.
  std::string crossed = wall_with({first});
  const std::string loop = poly_loop("0,0,0;10,0,0;10,0,10;0,0,10");
  crossed.replace(crossed.find(loop), loop.size(), poly_loop("0,0,0;10,0,10;10,0,0;0,0,10"));
  const ReadResult broken = read_text(crossed, "a.xml");
  EXPECT_EQ(broken.scene.polygons[0].holes.size(), 1u);
  EXPECT_FALSE(prepare(broken.scene));
}

TEST(GbXml, WithAPrefixAndWithoutTypes) {
  std::string text = gbxml(kWall);
  for (const char* name : {"gbXML", "Campus", "Surface", "Opening", "PolyLoop", "Coordinate",
                           "PlanarGeometry", "CartesianPoint", "AdjacentSpaceId"}) {
    for (const std::string mark : {"<", "</"}) {
      for (std::size_t at = 0; (at = text.find(mark + name, at)) != std::string::npos; at += 4) {
        if (text[at + mark.size() + std::string(name).size()] == 's') continue;
        text.insert(at + mark.size(), "gb:");
      }
    }
  }
  const std::size_t type = text.find(" surfaceType=\"ExteriorWall\"");
  text.erase(type, std::string(" surfaceType=\"ExteriorWall\"").size());
  EXPECT_THAT(ids_of(read_text(text, "x.gbxml").scene), ElementsAre("w", "o"));
}

TEST(GbXml, ErrorsNameTheirPlace) {
  const auto error = [](const std::string& text) { return error_of(text, "a.xml"); };
  EXPECT_EQ(error(gbxml(kWall, "Cubits")), "2:2: a lengthUnit 'Cubits'");
  EXPECT_THAT(error("<gbXML><Campus></gbXML>"), HasSubstr("no well-formed XML"));
  EXPECT_THAT(error("<gbXML/>"), HasSubstr("without a lengthUnit"));
  EXPECT_EQ(
      error(gbxml("<Surface id=\"w\" surfaceType=\"Roof\">\n<RectangularGeometry/>\n</Surface>")),
      "4:2: there is no PolyLoop");
  EXPECT_EQ(error(gbxml("<Surface id=\"w\" surfaceType=\"Roof\">\n" +
                        poly_loop("0,0,0;1,x,0;1,1,0") + "</Surface>")),
            "6:46: 'x' is not a number");
  EXPECT_EQ(error(gbxml("<Surface id=\"w\" surfaceType=\"Roof\">\n" + poly_loop("0,0,0;1,0,0") +
                        "</Surface>")),
            "5:18: a loop of 2 vertices");
  EXPECT_EQ(error(gbxml(kWall + kWall)), "16:2: a second surface 'w'");
  EXPECT_EQ(error(gbxml("<Surface id=\"w\" surfaceType=\"Dome\"/>")), "4:2: a surfaceType 'Dome'");
  ReadOptions options;
  options.skip_bad = true;
  const ReadResult result =
      read_text(gbxml(kWall + "<Surface id=\"b\" surfaceType=\"Roof\">" + poly_loop("0,0,0") +
                      "</Surface>" + "<Surface id=\"d\" surfaceType=\"Dome\">" +
                      poly_loop("0,0,0;1,0,0;1,1,0") + "</Surface>"),
                "a.xml", options);
  EXPECT_THAT(ids_of(result.scene), ElementsAre("w", "o"));
  ASSERT_EQ(result.left_out.size(), 2u);
  EXPECT_EQ(result.left_out[0].id, "b");
  EXPECT_EQ(result.left_out[1].id, "d");
}

}  // namespace
}  // namespace gnomon
