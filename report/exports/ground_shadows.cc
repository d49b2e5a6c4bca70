// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports/ground_shadows.h"

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "report/json/json_writer.h"
#include "report/sides/polygon_sides.h"
#include "scene/json/json_value.h"

namespace gnomon::report {

namespace {

bool is_level(const Scene& scene, const Polygon& polygon) {
  for (const VertexId vertex : polygon.loop) {
    if (!(scene.vertices[vertex][2] == scene.vertices[polygon.loop.front()][2])) return false;
  }
  return true;
}

/// Twice the area in the plan, positive if the loop is counter-clockwise seen from above.
double plan_area(const ResultPiece& piece) {
  double area = 0;
  const auto& first = piece.loop.front();
  for (std::size_t i = 1; i + 1 < piece.loop.size(); ++i) {
    const auto &a = piece.loop[i], &b = piece.loop[i + 1];
    area += (a[0] - first[0]) * (b[1] - first[1]) - (a[1] - first[1]) * (b[0] - first[0]);
  }
  return area;
}

/// "extra": {"cityjson": {"referenceSystem": ...}}; empty if there is none.
std::string reference_system(const Scene& scene) {
  if (scene.extra.find("\"referenceSystem\"") == std::string::npos) return {};
  const auto extra = parse_json_object(scene.extra, {});
  if (!extra) return {};
  const JsonValue* const city = find_member(*extra, "cityjson");
  if (city == nullptr || !city->IsObject()) return {};
  return text_of(find_member(*city, "referenceSystem")).value_or("");
}

void write_ring(JsonWriter& json, const ResultPiece& piece) {
  json.begin_array(JsonLayout::kInline);
  json.begin_array(JsonLayout::kInline);
  for (std::size_t i = 0; i <= piece.loop.size(); ++i) {  // closed
    const auto& point = piece.loop[i % piece.loop.size()];
    json.begin_array(JsonLayout::kInline);
    json.value(point[0]);
    json.value(point[1]);
    json.end_array();
  }
  json.end_array();
  json.end_array();
}

}  // namespace

void write_ground_shadows(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                          const ShadowResult& result, std::span<const ResultPiece> pieces) {
  using Key = std::tuple<std::uint32_t, std::uint32_t, LightState>;
  std::map<Key, std::vector<const ResultPiece*>> features;
  for (const ResultPiece& piece : pieces) {
    if (piece.state == LightState::kLit || piece.loop.size() < 3) continue;
    if (!is_level(scene, scene.polygons[piece.polygon]) || !(plan_area(piece) > 0)) continue;
    features[{piece.light, piece.polygon, piece.state}].push_back(&piece);
  }
  JsonWriter json(sink);
  json.begin_object();
  json.member("type", "FeatureCollection");
  if (!scene.name.empty()) json.member("name", scene.name);
  if (const std::string system = reference_system(scene); !system.empty()) {
    json.key("crs");
    json.begin_object(JsonLayout::kInline);
    json.member("type", "name");
    json.key("properties");
    json.begin_object(JsonLayout::kInline);
    json.member("name", system);
    json.end_object();
    json.end_object();
  }
  json.key("features");
  json.begin_array();
  for (const auto& [key, parts] : features) {
    const auto& [light, polygon, state] = key;
    json.begin_object(JsonLayout::kInline);
    json.member("type", "Feature");
    json.key("properties");
    json.begin_object(JsonLayout::kInline);
    json.member("polygon", scene.polygons[polygon].id);
    json.member("light", light_name(scene, prepared, result.lights[light]));
    json.member("class", name_of(state));
    json.member("height", scene.vertices[scene.polygons[polygon].loop.front()][2].nearest());
    json.end_object();
    json.key("geometry");
    json.begin_object(JsonLayout::kInline);
    json.member("type", "MultiPolygon");
    json.key("coordinates");
    json.begin_array(JsonLayout::kInline);
    for (const ResultPiece* piece : parts) write_ring(json, *piece);
    json.end_array();
    json.end_object();
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
