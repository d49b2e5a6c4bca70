// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports/class_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "report/json/json_writer.h"
#include "report/meshes/glb.h"
#include "report/sides/polygon_sides.h"
#include "report/text/little_endian.h"

namespace gnomon::report {

namespace {

/// The classes and their linear colours: those of the paper's colour plates.
struct ClassColour {
  LightState state;
  std::array<double, 3> colour;
};
constexpr ClassColour kClasses[] = {{LightState::kLit, {1.0, 0.82, 0.45}},
                                    {LightState::kPenumbra, {0.35, 0.35, 0.42}},
                                    {LightState::kUmbra, {0.03, 0.06, 0.35}},
                                    {LightState::kShadow, {0.08, 0.08, 0.12}}};

std::size_t class_index(LightState state) {
  return static_cast<std::size_t>(std::ranges::find(kClasses, state, &ClassColour::state) -
                                  std::begin(kClasses));
}

/// The triangles of one light and class: where they are in the buffer.
struct ClassNode {
  std::size_t offset = 0, vertices = 0;
  std::array<float, 3> low{}, high{};
};

class MeshBytes {
 public:
  explicit MeshBytes(const std::array<double, 3>& centre) : centre_(centre) {}

  void add(const ResultPiece& piece, ClassNode& node) {
    for (std::size_t i = 1; i + 1 < piece.loop.size(); ++i) {
      for (const std::size_t corner : {std::size_t{0}, i, i + 1}) {
        add_point(piece.loop[corner], node);
      }
    }
  }
  std::string bytes;

 private:
  void add_point(const std::array<double, 3>& point, ClassNode& node) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = static_cast<float>(point[axis] - centre_[axis]);
      append_little_endian(bytes, std::bit_cast<std::uint32_t>(value));
      node.low[axis] = node.vertices == 0 ? value : std::min(node.low[axis], value);
      node.high[axis] = node.vertices == 0 ? value : std::max(node.high[axis], value);
    }
    ++node.vertices;
  }

  std::array<double, 3> centre_;
};

/// The middle of the box around all pieces, as a float, so that the file's node holds it exactly.
/// Errors: kNumber.
Expected<std::array<double, 3>> centre_of(std::span<const ResultPiece> pieces) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> centre{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = kInfinity, high = -kInfinity;
    for (const ResultPiece& piece : pieces) {
      for (const auto& point : piece.loop) {
        if (!std::isfinite(static_cast<float>(point[axis]))) {
          return fail(ErrorCode::kNumber, "a vertex of a fragment is beyond single precision",
                      "coordinates that are numbers below 3.4e38");
        }
        low = std::min(low, point[axis]);
        high = std::max(high, point[axis]);
      }
    }
    if (low <= high) centre[axis] = static_cast<double>(static_cast<float>(low + (high - low) / 2));
  }
  return centre;
}

using Nodes = std::map<std::pair<std::uint32_t, std::size_t>, ClassNode>;  // by light and class

std::array<double, 3> as_doubles(const std::array<float, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// `list` of `count` objects; `write(i)` writes the members of one.
template <class Write>
void objects(JsonWriter& json, const char* list, std::size_t count, const Write& write) {
  json.key(list);
  json.begin_array();
  for (std::size_t i = 0; i < count; ++i) {
    json.begin_object(JsonLayout::kInline);
    write(i);
    json.end_object();
  }
  json.end_array();
}

void write_materials(JsonWriter& json) {
  json.key("materials");
  json.begin_array();
  for (const auto& [state, colour] : kClasses) write_unlit_material(json, name_of(state), colour);
  json.end_array();
}

void write_meshes(JsonWriter& json, const std::vector<ClassNode>& nodes, const Nodes& by_class) {
  auto place = by_class.begin();
  objects(json, "meshes", nodes.size(), [&](std::size_t i) {
    json.key("primitives");
    json.begin_array(JsonLayout::kInline);
    json.begin_object(JsonLayout::kInline);
    json.key("attributes");
    json.begin_object(JsonLayout::kInline);
    json.member("POSITION", i);
    json.end_object();
    json.member("material", (place++)->first.second);
    json.end_object();
    json.end_array();
  });
  objects(json, "accessors", nodes.size(), [&](std::size_t i) {
    json.member("bufferView", i);
    json.member("componentType", 5126);
    json.member("count", nodes[i].vertices);
    json.member("type", "VEC3");
    inline_array(json, "min", as_doubles(nodes[i].low));
    inline_array(json, "max", as_doubles(nodes[i].high));
  });
  objects(json, "bufferViews", nodes.size(), [&](std::size_t i) {
    json.member("buffer", 0);
    json.member("byteOffset", nodes[i].offset);
    json.member("byteLength", 12 * nodes[i].vertices);
  });
}

std::string gltf_json(const std::vector<std::string>& names, const std::vector<ClassNode>& nodes,
                      const Nodes& by_class, const std::array<double, 3>& centre,
                      std::size_t bytes) {
  StringSink sink;
  {
    JsonWriter json(sink);
    json.begin_object();
    begin_gltf(json, {}, !nodes.empty());
    if (!nodes.empty()) {
      objects(json, "nodes", nodes.size() + 1, [&](std::size_t i) {
        if (i > 0) {
          json.member("name", names[i - 1]);
          json.member("mesh", i - 1);
          return;
        }
        write_turn_to_y_up(json, centre);
        std::vector<std::size_t> children;
        for (std::size_t child = 1; child <= nodes.size(); ++child) children.push_back(child);
        inline_array(json, "children", children);
      });
      write_materials(json);
      write_meshes(json, nodes, by_class);
      objects(json, "buffers", 1, [&](std::size_t) { json.member("byteLength", bytes); });
    }
    json.end_object();
    json.finish();
  }
  return sink.text();
}

}  // namespace

Expected<std::string> class_mesh(const Scene& scene, const PreparedScene& prepared,
                                 const ShadowResult& result, std::span<const ResultPiece> pieces) {
  const auto centre = centre_of(pieces);
  if (!centre) return tl::unexpected(centre.error());
  std::map<std::pair<std::uint32_t, std::size_t>, std::vector<const ResultPiece*>> sorted;
  for (const ResultPiece& piece : pieces) {
    if (piece.loop.size() >= 3) {
      sorted[{piece.light, class_index(piece.state)}].push_back(&piece);
    }
  }
  MeshBytes mesh(*centre);
  Nodes by_class;
  std::vector<ClassNode> nodes;
  std::vector<std::string> names;
  for (const auto& [key, parts] : sorted) {
    ClassNode node;
    node.offset = mesh.bytes.size();
    for (const ResultPiece* piece : parts) mesh.add(*piece, node);
    nodes.push_back(node);
    by_class.emplace(key, node);
    names.push_back(light_name(scene, prepared, result.lights[key.first]) + " " +
                    std::string(name_of(kClasses[key.second].state)));
  }
  constexpr std::size_t kMost = 0xf0000000u;
  if (mesh.bytes.size() > kMost) {
    return fail(ErrorCode::kLimit, "the result is too large for glTF: more than 4 GB", ".vtp");
  }
  return glb_file(gltf_json(names, nodes, by_class, *centre, mesh.bytes.size()), mesh.bytes);
}

}  // namespace gnomon::report
