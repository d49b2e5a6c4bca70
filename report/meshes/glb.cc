// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/meshes/glb.h"

#include <cmath>
#include <cstdint>

#include "report/text/little_endian.h"

namespace gnomon::report {

namespace {

constexpr const char* kUnlit = "KHR_materials_unlit";

}  // namespace

void begin_gltf(JsonWriter& json, std::string_view name, bool has_nodes) {
  json.key("asset");
  json.begin_object(JsonLayout::kInline);
  json.member("version", "2.0");
  json.member("generator", "gnomon");
  json.end_object();
  json.member("scene", 0);
  json.key("scenes");
  json.begin_array();
  json.begin_object(JsonLayout::kInline);
  if (!name.empty()) json.member("name", name);
  if (has_nodes) inline_array(json, "nodes", std::array{0});
  json.end_object();
  json.end_array();
  if (has_nodes) inline_array(json, "extensionsUsed", std::array{kUnlit});
}

void write_turn_to_y_up(JsonWriter& json, const std::array<double, 3>& centre) {
  const double half = std::sqrt(0.5);  // a quarter turn about x
  inline_array(json, "rotation", std::array{-half, 0.0, 0.0, half});
  inline_array(json, "translation",
               std::array{centre[0], centre[2], centre[1] == 0 ? 0.0 : -centre[1]});
}

void write_unlit_material(JsonWriter& json, std::string_view name,
                          const std::array<double, 3>& colour) {
  json.begin_object(JsonLayout::kInline);
  json.member("name", name);
  json.key("pbrMetallicRoughness");
  json.begin_object(JsonLayout::kInline);
  inline_array(json, "baseColorFactor", std::array{colour[0], colour[1], colour[2], 1.0});
  json.member("metallicFactor", 0);
  json.end_object();
  json.key("extensions");
  json.begin_object(JsonLayout::kInline);
  json.key(kUnlit);
  json.begin_object(JsonLayout::kInline);
  json.end_object();
  json.end_object();
  json.end_object();
}

std::string glb_file(std::string json, const std::string& bytes) {
  while (json.size() % 4 != 0) json += ' ';
  const bool has_buffer = !bytes.empty();
  std::string text = "glTF";
  append_little_endian(text, std::uint32_t{2});
  append_little_endian(
      text, static_cast<std::uint32_t>(12 + 8 + json.size() + (has_buffer ? 8 + bytes.size() : 0)));
  append_little_endian(text, static_cast<std::uint32_t>(json.size()));
  text += "JSON";
  text += json;
  if (has_buffer) {
    append_little_endian(text, static_cast<std::uint32_t>(bytes.size()));
    text.append("BIN\0", 4);
    text += bytes;
  }
  return text;
}

}  // namespace gnomon::report
