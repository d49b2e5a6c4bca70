// SPDX-License-Identifier: LGPL-3.0-or-later
// The writer of scenes as JSON. The layout is its own, one vertex and one polygon a line, so that
// people can read and compare scenes. It is also exact: numbers are written as the scene holds
// them, decimals too, where report/json/json_writer.h has doubles.
#include "scene/files/writers.h"

namespace gnomon {

namespace {

void append_string(std::string& text, std::string_view value) {
  constexpr char kHex[] = "0123456789abcdef";
  text += '"';
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      text += "\\u00";
      text += kHex[byte >> 4];
      text += kHex[byte & 15];
    } else {
      text += c;
    }
  }
  text += '"';
}

void append_indices(std::string& text, const std::vector<VertexId>& indices) {
  text += '[';
  for (std::size_t k = 0; k < indices.size(); ++k) {
    if (k != 0) text += ", ";
    text += std::to_string(indices[k]);
  }
  text += ']';
}

class SceneText {
 public:
  explicit SceneText(const Scene& scene) : scene_(scene) {}

  Expected<std::string> write() {
    text_ += R"({"format": "gnomon-scene", "version": 1, "name": )";
    append_string(text_, scene_.name);
    if (scene_.numbers == NumberMeaning::kDecimal) text_ += R"(, "numbers": "decimal")";
    if (scene_.two_sided) text_ += R"(, "two_sided": true)";
    if (!scene_.extra.empty()) text_ += ",\n \"extra\": " + scene_.extra;
    if (auto done =
            list("vertices", scene_.vertices.size(), [this](std::size_t i) { return vertex(i); });
        !done) {
      return tl::unexpected(std::move(done.error()));
    }
    if (auto done =
            list("polygons", scene_.polygons.size(), [this](std::size_t i) { return polygon(i); });
        !done) {
      return tl::unexpected(std::move(done.error()));
    }
    if (!scene_.lights.empty()) {
      if (auto done =
              list("lights", scene_.lights.size(), [this](std::size_t i) { return light(i); });
          !done) {
        return tl::unexpected(std::move(done.error()));
      }
    }
    text_ += "\n}\n";
    return std::move(text_);
  }

 private:
  template <class Element>
  Expected<void> list(const char* key, std::size_t count, const Element& element) {
    text_ += std::string(",\n \"") + key + "\": [";
    for (std::size_t i = 0; i < count; ++i) {
      text_ += i == 0 ? "\n  " : ",\n  ";
      if (auto done = element(i); !done) return done;
    }
    text_ += count == 0 ? "]" : "\n ]";
    return {};
  }

  Expected<void> position(const Position& position, const std::string& pointer) {
    text_ += '[';
    auto done = append_position(text_, position, scene_.numbers, ", ", pointer);
    text_ += ']';
    return done;
  }

  Expected<void> vertex(std::size_t i) {
    return position(scene_.vertices[i], "/vertices/" + std::to_string(i));
  }

  void id(const std::string& id, std::size_t index) {
    if (id == std::to_string(index)) return;  // the default
    text_ += "\"id\": ";
    append_string(text_, id);
    text_ += ", ";
  }

  Expected<void> polygon(std::size_t i) {
    const Polygon& polygon = scene_.polygons[i];
    text_ += '{';
    id(polygon.id, i);
    text_ += "\"loop\": ";
    append_indices(text_, polygon.loop);
    if (!polygon.holes.empty()) {
      text_ += ", \"holes\": [";
      for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
        if (h != 0) text_ += ", ";
        append_indices(text_, polygon.holes[h]);
      }
      text_ += ']';
    }
    if (polygon.two_sided) {
      text_ += *polygon.two_sided ? ", \"two_sided\": true" : ", \"two_sided\": false";
    }
    if (!polygon.casts) text_ += ", \"casts\": false";
    text_ += '}';
    return {};
  }

  Expected<void> light(std::size_t i) {
    const Light& light = scene_.lights[i];
    const std::string pointer = "/lights/" + std::to_string(i);
    text_ += '{';
    id(light.id, i);
    switch (light.type) {
      case LightType::kPoint:
        text_ += R"("type": "point", "position": )";
        if (auto done = position(light.position, pointer + "/position"); !done) return done;
        break;
      case LightType::kDirectional:
        text_ += R"("type": "directional", "to_light": )";
        if (auto done = position(light.position, pointer + "/to_light"); !done) return done;
        break;
      case LightType::kArea:
        text_ += R"("type": "area", "loop": [)";
        for (std::size_t k = 0; k < light.loop.size(); ++k) {
          if (k != 0) text_ += ", ";
          if (auto done = position(light.loop[k], pointer + "/loop/" + std::to_string(k)); !done) {
            return done;
          }
        }
        text_ += ']';
        break;
    }
    if (!(light.intensity == Number(1.0))) {
      auto intensity = light.intensity.to_text(scene_.numbers);
      if (!intensity) {
        intensity.error().where.pointer = pointer + "/intensity";
        return tl::unexpected(std::move(intensity.error()));
      }
      text_ += ", \"intensity\": " + *intensity;
    }
    if (auto done = region(light, pointer + "/region"); !done) return done;
    text_ += '}';
    return {};
  }

  Expected<void> region(const Light& light, const std::string& pointer) {
    if (light.region.empty()) return {};
    text_ += ", \"region\": [";
    for (std::size_t i = 0; i < light.region.size(); ++i) {
      text_ += i == 0 ? "[" : ", [";
      for (std::size_t k = 0; k < light.region[i].size(); ++k) {
        if (k != 0) text_ += ", ";
        const std::string own = pointer + '/' + std::to_string(i) + '/' + std::to_string(k);
        if (auto done = position(light.region[i][k], own); !done) return done;
      }
      text_ += ']';
    }
    text_ += ']';
    return {};
  }

  const Scene& scene_;
  std::string text_;
};

}  // namespace

Expected<std::string> write_json(const Scene& scene) { return SceneText(scene).write(); }

}  // namespace gnomon
