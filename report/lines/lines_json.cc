// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/lines/lines_json.h"

#include <array>
#include <utility>

#include "report/json/json_writer.h"

namespace gnomon::report {
namespace {

using PositionText = std::array<std::string, 3>;

Expected<PositionText> text_of(const Position& position, NumberMeaning numbers) {
  PositionText result;
  for (std::size_t k = 0; k < 3; ++k) {
    auto text = position[k].to_text(numbers);
    if (!text) return tl::unexpected(std::move(text.error()));
    result[k] = *std::move(text);
  }
  return result;
}

/// For each vertex of the geometry one of the scene at the same place.
std::vector<std::uint32_t> input_vertices(const PreparedScene& prepared) {
  std::vector<std::uint32_t> input(prepared.geometry.positions.size(), PreparedScene::kUnused);
  for (std::uint32_t i = 0; i < prepared.vertex_of_input.size(); ++i) {
    const std::uint32_t vertex = prepared.vertex_of_input[i];
    if (vertex != PreparedScene::kUnused && input[vertex] == PreparedScene::kUnused) {
      input[vertex] = i;
    }
  }
  return input;
}

class LinesWriter {
 public:
  LinesWriter(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
              const DrawnLines& drawn)
      : json_(sink),
        scene_(scene),
        prepared_(prepared),
        drawn_(drawn),
        input_(input_vertices(prepared)) {}

  Expected<void> write() {
    json_.begin_object();
    json_.member("format", "gnomon-lines");
    json_.member("version", 1);
    json_.member("scene", scene_.name);
    json_.member("geometry", drawn_.geometry);
    if (auto done = position("eye", drawn_.camera.eye); !done) return done;
    json_.key("lights");
    json_.begin_array(JsonLayout::kInline);
    for (const ShadowedLines& light : drawn_.shadowed) json_.value(scene_.lights[light.light].id);
    json_.end_array();
    json_.key("lines");
    json_.begin_array();
    for (std::size_t i = 0; i < drawn_.edges.size(); ++i) {
      if (auto done = line(i); !done) return done;
    }
    json_.end_array();
    json_.end_object();
    json_.finish();
    return {};
  }

 private:
  Expected<void> position(std::string_view key, const Position& at) {
    const auto text = text_of(at, scene_.numbers);
    if (!text) return tl::unexpected(text.error());
    json_.key(key);
    json_.begin_array(JsonLayout::kInline);
    for (const std::string& coordinate : *text) json_.value(coordinate);
    json_.end_array();
    return {};
  }

  Expected<void> line(std::size_t i) {
    const OutlineEdge& edge = drawn_.edges[i];
    const EdgeEnds ends = prepared_.geometry.edges[edge.edge];
    json_.begin_object(JsonLayout::kInline);
    for (const auto& [key, vertex] : {std::pair("from", ends.a), std::pair("to", ends.b)}) {
      if (auto done = position(key, scene_.vertices[input_[vertex]]); !done) return done;
    }
    json_.key("polygons");
    json_.begin_array(JsonLayout::kInline);
    for (const std::uint32_t polygon : edge.polygons) json_.value(scene_.polygons[polygon].id);
    json_.end_array();
    json_.key("hidden_by");
    parts(drawn_.seen.lines[i]);
    if (!drawn_.shadowed.empty()) {
      json_.key("shadowed_by");
      json_.begin_array(JsonLayout::kInline);
      for (const ShadowedLines& light : drawn_.shadowed) parts(light.lines.lines[i]);
      json_.end_array();
    }
    json_.end_object();
    return {};
  }

  void parts(const HiddenLine& line) {
    json_.begin_array(JsonLayout::kInline);
    for (const LinePart& part : line.parts) {
      json_.begin_array(JsonLayout::kInline);
      json_.value(part.end.get_str());
      json_.value(part.hidden_by);
      json_.end_array();
    }
    json_.end_array();
  }

  JsonWriter json_;
  const Scene& scene_;
  const PreparedScene& prepared_;
  const DrawnLines& drawn_;
  std::vector<std::uint32_t> input_;
};

}  // namespace

Expected<void> write_lines_json(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                                const DrawnLines& drawn) {
  return LinesWriter(sink, scene, prepared, drawn).write();
}

}  // namespace gnomon::report
