// SPDX-License-Identifier: LGPL-3.0-or-later
// The syntax of epJSON: an object of classes, each an object of objects by name, each an object of
// fields by name. Numbers are kept as their texts.
#include <array>
#include <utility>

#include "scene/energyplus/energy_model.h"
#include "scene/json/json_tape.h"

namespace gnomon {

namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

Expected<EnergyField> field_of(const JsonNode& node) {
  switch (node.kind()) {
    case JsonKind::kString:
      return EnergyField{node.string(), node.offset()};
    case JsonKind::kNumber:
      return EnergyField{std::string(node.number()), node.offset()};
    case JsonKind::kNull:
      return EnergyField{{}, node.offset()};
    default:
      return node.tape().wrong_kind(node, "a text or a number");
  }
}

/// "vertices": [{"vertex_x_coordinate": 1, ...}, ...].
Expected<void> read_vertex_list(const JsonNode& list, EnergyObject& object) {
  const JsonTape& tape = list.tape();
  if (!list.is_array()) return tape.wrong_kind(list, "an array of vertices");
  for (JsonNode at = list.begin(); at != list.end(); at = at.next()) {
    if (!at.is_object()) return tape.wrong_kind(at, "a vertex: an object");
    for (const std::string_view axis : kAxes) {
      const std::string key = "vertex_" + std::string(axis) + "_coordinate";
      const auto coordinate = at.find(key);
      if (!coordinate) return tape.missing(at, key, "a number");
      auto field = field_of(*coordinate);
      if (!field) return tl::unexpected(std::move(field.error()));
      object.vertices.push_back(*std::move(field));
    }
  }
  return {};
}

/// "vertex_1_x_coordinate": 1, ... up to the first that is missing.
Expected<void> read_numbered_vertices(const JsonNode& node, EnergyObject& object) {
  for (std::size_t number = 1;; ++number) {
    for (const std::string_view axis : kAxes) {
      const std::string key =
          "vertex_" + std::to_string(number) + "_" + std::string(axis) + "_coordinate";
      const auto coordinate = node.find(key);
      if (!coordinate && axis == kAxes[0]) return {};
      if (!coordinate) return node.tape().missing(node, key, "a number");
      auto field = field_of(*coordinate);
      if (!field) return tl::unexpected(std::move(field.error()));
      object.vertices.push_back(*std::move(field));
    }
  }
}

Expected<EnergyObject> read_object(const JsonNode& key, const JsonNode& node,
                                   const EnergyClass& type) {
  EnergyObject object;
  object.type = &type;
  object.offset = key.offset();
  if (!node.is_object()) return node.tape().wrong_kind(node, "an object with the fields");
  for (const std::string_view name : type.fields) {
    const auto found = node.find(name);
    if (found) {
      auto field = field_of(*found);
      if (!field) return tl::unexpected(std::move(field.error()));
      object.fields.push_back(*std::move(field));
    } else {
      object.fields.push_back({name == "name" ? key.string() : std::string(), key.offset()});
    }
  }
  if (!type.has_vertices) return object;
  const auto vertices = node.find("vertices");
  auto done = vertices ? read_vertex_list(*vertices, object) : read_numbered_vertices(node, object);
  if (!done) return tl::unexpected(std::move(done.error()));
  return object;
}

}  // namespace

Expected<EnergyModel> parse_epjson(const std::string& text, const std::string& file) {
  if (auto readable = check_is_utf8(text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  const auto tape = JsonTape::parse(text, file);
  if (!tape) return tl::unexpected(tape.error());
  const JsonNode root = tape->root();
  if (!root.is_object()) return tape->wrong_kind(root, "an object of classes");
  EnergyModel model{text, file, {}};
  for (JsonNode key = root.begin(); key != root.end(); key = key.next().next()) {
    const EnergyClass* const type = energy_class(key.string());
    if (type == nullptr) continue;
    const JsonNode list = key.next();
    if (!list.is_object()) return tape->wrong_kind(list, "an object of objects by name");
    for (JsonNode name = list.begin(); name != list.end(); name = name.next().next()) {
      auto object = read_object(name, name.next(), *type);
      if (!object) return tl::unexpected(std::move(object.error()));
      model.objects.push_back(*std::move(object));
    }
  }
  return model;
}

}  // namespace gnomon
