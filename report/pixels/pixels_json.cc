// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pixels/pixels_json.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "report/json/json_writer.h"

namespace gnomon::report {
namespace {

class PixelsWriter {
 public:
  PixelsWriter(TextSink& sink, const Scene& scene, const PixelClaims& claims)
      : json_(sink), scene_(scene), claims_(claims) {
    for (const std::uint32_t polygon : claims.polygon) {
      if (polygon != PixelClaims::kNothing) numbers_.emplace(polygon, 0);
    }
    std::int64_t next = 0;
    for (auto& [polygon, number] : numbers_) number = next++;
  }

  void write(const std::array<std::string, 3>& eye) {
    json_.begin_object();
    json_.member("format", "gnomon-pixels");
    json_.member("version", 1);
    json_.member("scene", scene_.name);
    json_.member("geometry", claims_.geometry);
    json_.member("kernel", claims_.kernel);
    json_.member("algorithm", claims_.algorithm);
    json_.key("camera");
    json_.begin_object();
    list("eye", eye);
    list("right", claims_.camera.right);
    list("up", claims_.camera.up);
    list("forward", claims_.camera.forward);
    json_.end_object();
    json_.member("width", claims_.camera.width);
    json_.member("height", claims_.camera.height);
    json_.key("lights");
    json_.begin_array(JsonLayout::kInline);
    for (const std::uint32_t light : claims_.lights) json_.value(scene_.lights[light].id);
    json_.end_array();
    json_.key("polygons");
    json_.begin_array(JsonLayout::kInline);
    for (const auto& [polygon, number] : numbers_) json_.value(scene_.polygons[polygon].id);
    json_.end_array();
    json_.key("rows");
    json_.begin_array();
    for (std::size_t j = 0; j < claims_.camera.height; ++j) row(j);
    json_.end_array();
    json_.end_object();
    json_.finish();
  }

 private:
  template <class List>
  void list(std::string_view key, const List& values) {
    json_.key(key);
    json_.begin_array(JsonLayout::kInline);
    for (const auto& value : values) json_.value(value);
    json_.end_array();
  }
  void row(std::size_t j) {
    const std::size_t width = claims_.camera.width, first = j * width;
    json_.begin_array(JsonLayout::kInline);
    for (std::size_t i = 0, end = 0; i < width; i = end) {
      const std::uint32_t polygon = claims_.polygon[first + i];
      const std::uint64_t lit = claims_.lit_by[first + i];
      while (end < width && claims_.polygon[first + end] == polygon &&
             claims_.lit_by[first + end] == lit) {
        ++end;
      }
      json_.begin_array(JsonLayout::kInline);
      json_.value(end - i);
      json_.value(polygon == PixelClaims::kNothing ? std::int64_t{-1} : numbers_.at(polygon));
      json_.value(lit);
      json_.end_array();
    }
    json_.end_array();
  }

  JsonWriter json_;
  const Scene& scene_;
  const PixelClaims& claims_;
  std::map<std::uint32_t, std::int64_t> numbers_;  // of the polygons seen, in order of the scene
};

}  // namespace

Expected<void> write_pixels_json(TextSink& sink, const Scene& scene, const PixelClaims& claims) {
  std::array<std::string, 3> eye;
  for (std::size_t k = 0; k < 3; ++k) {
    auto text = claims.camera.eye[k].to_text(scene.numbers);
    if (!text) return tl::unexpected(std::move(text.error()));
    eye[k] = *std::move(text);
  }
  PixelsWriter(sink, scene, claims).write(eye);
  return {};
}

}  // namespace gnomon::report
