// SPDX-License-Identifier: GPL-3.0-or-later
// Results for other programs, read back: VTK's by its XML, GeoJSON by its JSON, glTF by our own
// reader. What is there is what the result says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <sstream>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/scene/read.h"
#include "report/certificate/certificate.h"
#include "report/exports/result_export.h"
#include "report/exports/verdict_arrays.h"
#include "report/sides/claims_of.h"

namespace gnomon::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A floor of 4 by 4, its west half under a roof; a wall that looks away; and a lamp.
constexpr const char* kScene = R"({"format": "gnomon-scene", "version": 1, "name": "yard",
 "extra": {"cityjson": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"}},
 "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0], [0,0,1],[2,0,1],[2,4,1],[0,4,1], [9,0,0],[9,1,0],[9,1,1]],
 "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "roof", "loop": [4,5,6,7]},
              {"id": "wall", "loop": [8,10,9]}],
 "lights": [{"id": "zenith", "type": "directional", "to_light": [0.1,0,1]},
            {"id": "bulb", "type": "point", "position": [1,1,9]}]})";

struct Classified {
  Scene scene;
  PreparedScene prepared;
  ShadowResult result;

  std::string exported(ExportFormat format) const {
    StringSink sink;
    const auto done = write_export(sink, format, scene, prepared, result);
    EXPECT_TRUE(done) << to_string(done.error());
    return sink.text();
  }
};

Classified classify(const std::string& text, MethodId method = MethodId::kSectors) {
  Classified all;
  auto read = parse_scene(text, "test.json");
  EXPECT_TRUE(read) << to_string(read.error());
  all.scene = std::move(read->scene);
  auto prepared = prepare(all.scene);
  EXPECT_TRUE(prepared) << to_string(prepared.error());
  all.prepared = std::move(*prepared);
  ShadowOptions options;
  options.method.point = method;
  options.output.points = true;
  auto result = compute_shadows(all.prepared, options);
  EXPECT_TRUE(result);
  all.result = std::move(*result);
  return all;
}

std::vector<double> numbers(const pugi::xml_node& parent, const char* name) {
  const pugi::xml_node array = parent.find_child_by_attribute("Name", name);
  EXPECT_TRUE(array) << name;
  std::istringstream text(array.child_value());
  std::vector<double> values;
  for (double value = 0; text >> value;) values.push_back(value);
  return values;
}

/// Texts that are lists of bytes, each with a 0 behind it.
std::vector<std::string> texts(const pugi::xml_node& parent, const char* name) {
  std::vector<std::string> all(1);
  for (const double byte : numbers(parent, name)) {
    if (byte == 0) {
      all.emplace_back();
    } else {
      all.back() += static_cast<char>(byte);
    }
  }
  all.pop_back();
  return all;
}

TEST(Exports, VtpHoldsEveryPieceWithItsArrays) {
  const Classified all = classify(kScene);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(all.exported(ExportFormat::kVtp).c_str()));
  const pugi::xml_node data = document.child("VTKFile").child("PolyData");
  EXPECT_THAT(texts(data.child("FieldData"), "polygon_ids"), ElementsAre("floor", "roof", "wall"));
  EXPECT_THAT(texts(data.child("FieldData"), "light_ids"), ElementsAre("zenith", "bulb"));
  const pugi::xml_node piece = data.child("Piece"), cells = piece.child("CellData");
  const auto points = numbers(piece.child("Points"), "Points");
  const auto connectivity = numbers(piece.child("Polys"), "connectivity");
  const auto offsets = numbers(piece.child("Polys"), "offsets");
  EXPECT_EQ(points.size(), 3 * piece.attribute("NumberOfPoints").as_uint());
  EXPECT_EQ(offsets.size(), piece.attribute("NumberOfPolys").as_uint());
  EXPECT_EQ(offsets.back(), static_cast<double>(connectivity.size()));
  std::map<std::string, std::vector<double>> arrays;
  for (const char* name :
       {"polygon", "light", "caster", "side", "class", "lit_share", "lit_share_width"}) {
    arrays[name] = numbers(cells, name);
    EXPECT_EQ(arrays[name].size(), offsets.size()) << name;
  }
  // Areas of the lit cells of each polygon under each light are its share.
  std::map<std::pair<double, double>, double> lit, whole;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto first = static_cast<std::size_t>(i == 0 ? 0 : offsets[i - 1]);
    std::array<double, 3> sum{};
    for (auto k = first; k < static_cast<std::size_t>(offsets[i]); ++k) {
      const auto next = k + 1 < static_cast<std::size_t>(offsets[i]) ? k + 1 : first;
      const double* a = &points[3 * static_cast<std::size_t>(connectivity[k])];
      const double* b = &points[3 * static_cast<std::size_t>(connectivity[next])];
      for (std::size_t x = 0; x < 3; ++x) {
        sum[x] += a[(x + 1) % 3] * b[(x + 2) % 3] - a[(x + 2) % 3] * b[(x + 1) % 3];
      }
    }
    const double area = std::hypot(sum[0], sum[1], sum[2]) / 2;
    const std::pair key(arrays["light"][i], arrays["polygon"][i]);
    whole[key] += area;
    if (arrays["class"][i] == 0) lit[key] += area;
    if (arrays["caster"][i] >= 0) {
      EXPECT_EQ(arrays["class"][i], 3);
      EXPECT_EQ(arrays["caster"][i], 1);
    }
  }
  ASSERT_EQ(whole.size(), 6u);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const std::pair key(arrays["light"][i], arrays["polygon"][i]);
    EXPECT_NEAR(lit[key] / whole[key], arrays["lit_share"][i], 1e-12);
  }
  // The roof's shadow under the sun is moved by 0.1 to the west.
  EXPECT_NEAR((lit[{0, 0}]), 16 - 1.9 * 4, 1e-12);
}

/// By the bounds of an interval of doubles around what is true.
constexpr double kNear = 1e-12;

TEST(Exports, VtpHoldsTheErrorsOfRuns) {
  const Classified all = classify(kScene);
  const Claims right = claims_of(all.scene, all.prepared, all.result, "right", false);
  Claims wrong = right;
  wrong.name = "a<b> & \"c\"";
  // Under the sun the shadow on the floor, 1.9 by 4 of 4 by 4, is said to be lit.
  ASSERT_EQ(wrong.lights[0].polygons[0].id, "floor");
  for (ClaimedFragment& fragment : wrong.lights[0].polygons[0].fragments) {
    fragment.state = LightState::kLit;
    fragment.caster.clear();
  }
  const std::vector<std::uint32_t> lights = {0, 1};
  Certificate certificate = certificate_of(all.scene, all.prepared, lights);
  for (const Claims& claims : {right, wrong}) {
    auto report = oracle::certify(all.scene, all.prepared, claims, {});
    ASSERT_TRUE(report) << to_string(report.error());
    certificate.runs.push_back(foreign_run(claims.name, claims));
    certificate.runs.back().report = std::move(*report);
  }
  certificate.runs.emplace_back().name = "tired";  // has no report
  StringSink sink;
  ASSERT_TRUE(write_verdict_vtp(sink, certificate, all.result));
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(sink.text().c_str()));
  const pugi::xml_node data = document.child("VTKFile").child("PolyData");
  EXPECT_THAT(texts(data.child("FieldData"), "run_ids"), ElementsAre("right", wrong.name, "tired"));
  EXPECT_THAT(texts(data.child("FieldData"), "run_verdicts"),
              ElementsAre("within tolerance", "failed", "gave up"));
  const pugi::xml_node cells = data.child("Piece").child("CellData");
  const auto polygons = numbers(cells, "polygon"), of_lights = numbers(cells, "light");
  const auto shares = numbers(cells, ("wrong_share " + wrong.name).c_str());
  const auto widths = numbers(cells, ("wrong_width " + wrong.name).c_str());
  ASSERT_EQ(shares.size(), polygons.size());
  ASSERT_EQ(widths.size(), polygons.size());
  for (const double share : numbers(cells, "wrong_share right")) EXPECT_NEAR(share, 0, kNear);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const bool is_wrong = polygons[i] == 0 && of_lights[i] == 0;
    EXPECT_NEAR(shares[i], is_wrong ? 1.9 / 4 : 0, kNear);
    EXPECT_NEAR(widths[i], is_wrong ? 1.9 : 0, is_wrong ? 0.01 : kNear);
  }
  EXPECT_TRUE(cells.find_child_by_attribute("Name", "wrong_share right"));
  EXPECT_FALSE(cells.find_child_by_attribute("Name", "wrong_share tired"));
}

TEST(Exports, ErrorsOfLightsThatWereNotJudgedAreMinusOne) {
  const Classified all = classify(kScene);
  const Claims claims = claims_of(all.scene, all.prepared, all.result, "one", false);
  const std::vector<std::uint32_t> sun = {0};
  Certificate certificate = certificate_of(all.scene, all.prepared, sun);
  oracle::CertifyOptions options;
  options.lights = sun;
  auto report = oracle::certify(all.scene, all.prepared, claims, options);
  ASSERT_TRUE(report);
  certificate.runs.push_back(foreign_run("one", claims));
  certificate.runs.back().report = std::move(*report);
  const auto pieces = result_pieces(all.prepared, all.result);
  ASSERT_TRUE(pieces);
  const auto arrays = verdict_arrays(certificate, all.result, *pieces);
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_EQ(arrays[0].name, "wrong_share one");
  EXPECT_EQ(arrays[1].name, "wrong_width one");
  for (std::size_t i = 0; i < pieces->size(); ++i) {
    const bool is_judged = (*pieces)[i].light == 0;
    EXPECT_EQ(arrays[0].values[i] < 0, !is_judged);
    EXPECT_EQ(arrays[1].values[i] < 0, !is_judged);
  }
}

TEST(Exports, GeoJsonHoldsShadowsOnLevelGround) {
  const Classified all = classify(kScene);
  rapidjson::Document json;
  json.Parse(all.exported(ExportFormat::kGeoJson).c_str());
  ASSERT_FALSE(json.HasParseError());
  EXPECT_STREQ(json["crs"]["properties"]["name"].GetString(),
               "https://www.opengis.net/def/crs/EPSG/0/7415");
  const auto& features = json["features"];
  // The roof is lit, and the wall looks away and is not level.
  ASSERT_EQ(features.Size(), 2u);
  double area = 0;
  EXPECT_STREQ(features[0]["properties"]["polygon"].GetString(), "floor");
  EXPECT_STREQ(features[0]["properties"]["light"].GetString(), "zenith");
  EXPECT_STREQ(features[0]["properties"]["class"].GetString(), "shadow");
  for (const auto& polygon : features[0]["geometry"]["coordinates"].GetArray()) {
    const auto& ring = polygon[0];
    EXPECT_EQ(ring[0][0].GetDouble(), ring[ring.Size() - 1][0].GetDouble());
    double twice = 0;
    for (rapidjson::SizeType i = 0; i + 1 < ring.Size(); ++i) {
      twice += ring[i][0].GetDouble() * ring[i + 1][1].GetDouble() -
               ring[i][1].GetDouble() * ring[i + 1][0].GetDouble();
    }
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_NEAR(area, 1.9 * 4, 1e-12);
}

TEST(Exports, GlbHasANodeForEachLightAndClass) {
  const Classified all = classify(kScene);
  const auto read = parse_scene(all.exported(ExportFormat::kGlb), "back.glb");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_THAT(read->scene.extra, HasSubstr("\"zenith lit\""));
  EXPECT_THAT(read->scene.extra, HasSubstr("\"bulb shadow\""));
  double area = 0;
  for (const Polygon& polygon : read->scene.polygons) {
    if (!polygon.id.starts_with("zenith shadow/")) continue;
    std::array<std::array<double, 3>, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners[i][axis] = read->scene.vertices[polygon.loop[i]][axis].nearest();
      }
    }
    // On the floor, seen from above: the file's y axis points upwards, and is turned back.
    if (std::max({corners[0][0], corners[1][0], corners[2][0]}) > 5) continue;
    for (const auto& corner : corners) EXPECT_NEAR(corner[2], 0, 1e-6);
    area += ((corners[1][0] - corners[0][0]) * (corners[2][1] - corners[0][1]) -
             (corners[1][1] - corners[0][1]) * (corners[2][0] - corners[0][0])) /
            2;
  }
  EXPECT_NEAR(area, 1.9 * 4, 1e-5);
}

TEST(Exports, CityJsonHasSharesAsAttributes) {
  const Classified all = classify(kScene);
  const std::string text = all.exported(ExportFormat::kCityJson);
  rapidjson::Document json;
  json.Parse(text.c_str());
  ASSERT_FALSE(json.HasParseError());
  const auto& attributes = json["CityObjects"]["floor"]["attributes"];
  EXPECT_NEAR(attributes["sunlit"]["zenith"].GetDouble(), 1 - 1.9 / 4, 1e-12);
  EXPECT_NEAR(attributes["sunlit_surfaces"]["zenith"][0].GetDouble(), 1 - 1.9 / 4, 1e-12);
  EXPECT_EQ(json["CityObjects"]["roof"]["attributes"]["sunlit"]["bulb"].GetDouble(), 1);
  EXPECT_TRUE(parse_scene(text, "back.city.json"));
}

TEST(Exports, FragmentsThatLieOverEachOtherAreRefused) {
  Classified all = classify(kScene);
  all.result.lights[0].cover = Cover::kOverlay;
  StringSink sink;
  const auto done = write_export(sink, ExportFormat::kVtp, all.scene, all.prepared, all.result);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kUsage);
}

TEST(Exports, NamesTellTheFormat) {
  EXPECT_EQ(export_format("a.VTP").value(), ExportFormat::kVtp);
  EXPECT_EQ(export_format("a.geojson").value(), ExportFormat::kGeoJson);
  EXPECT_EQ(export_format("a.b.glb").value(), ExportFormat::kGlb);
  EXPECT_THAT(export_format("a.vtk").error().expected,
              HasSubstr(".vtp, .geojson, .glb or .city.json"));
}

}  // namespace
}  // namespace gnomon::report
