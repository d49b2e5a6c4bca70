// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "gnomon/scene/digest.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/validate.h"
#include "gnomon/scene/write.h"
#include "scene/files/foreign_formats.h"

namespace gnomon::fuzzers {

namespace {

bool same_light(const Light& a, const Light& b) {
  return a.id == b.id && a.type == b.type && a.position == b.position && a.loop == b.loop &&
         a.intensity == b.intensity;
}

std::string written(const Scene& scene, SceneFormat format) {
  const auto result = scene_to_text(scene, format);
  if (!result) broken("what was read cannot be written: " + to_string(result.error()));
  return result->text;
}

Scene read_back(const std::string& text, const std::string& file, const ReadOptions& options) {
  auto result = parse_scene(text, file, options);
  if (!result) broken("what was written cannot be read: " + to_string(result.error()));
  return std::move(result->scene);
}

void check_scene(const Scene& scene, SceneFormat format, NumberMeaning meaning, bool lights_only) {
  const auto valid = lights_only ? validate_lights(scene) : validate_scene(scene);
  if (!valid) broken("an invalid scene was read: " + to_string(valid.error()));
  if (lights_only) return;
  require(scene.numbers == meaning || format == SceneFormat::kJson, "numbers of another meaning");
  require(geometry_digest(scene).starts_with("sha256:"), "no digest");

  const std::string text = written(scene, SceneFormat::kJson);
  const Scene back = read_back(text, "back.json", {});
  if (const std::string what = difference(scene, back); !what.empty()) {
    broken("read back from JSON, not the same " + what);
  }
  require(written(back, SceneFormat::kJson) == text, "written again, other JSON");
  require(geometry_digest(back) == geometry_digest(scene), "another digest");
  const std::vector<std::string> writable = written_format_names();
  if (format == SceneFormat::kJson ||
      std::find(writable.begin(), writable.end(), format_name(format)) == writable.end()) {
    return;
  }
  if (format == SceneFormat::kCityJson) {
    // Integers of many digits it cannot hold, and it says what else it cannot.
    const auto city = scene_to_text(scene, format);
    require(city || city.error().code == ErrorCode::kLimit, "a city model cannot be written");
    if (!city || !city->warnings.empty()) return;
  }
  ReadOptions options;
  options.numbers = scene.numbers;
  options.format = format;
  const Scene mesh = read_back(written(scene, format), scene.name, options);
  if (const std::string what = difference(scene, mesh); !what.empty()) {
    broken("read back from a mesh, not the same " + what);
  }
}

}  // namespace

void broken(const std::string& what) {
  std::fprintf(stderr, "broken: %s\n", what.c_str());
  std::abort();
}

void check_error(const Error& error, std::string_view file, std::string_view text, bool in_text) {
  const std::string shown = to_string(error);
  require(!error.what.empty(), "an error without words");
  require(error.where.file == file, "an error without its file: " + shown);
  // What is quoted is made harmless; nothing else in a message comes from the file.
  require(std::none_of(shown.begin(), shown.end(),
                       [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }),
          "control characters in a message: " + shown);
  // In binary data a place is told as a byte.
  if (!in_text || error.what.find("(byte ") != std::string::npos) return;
  // That a file is of another format is said of the whole of it.
  if (error.where.line == 0 && (foreign_format(text) || format_by_content(text))) return;
  require(error.where.line > 0 && error.where.column > 0, "an error without a place: " + shown);
  const auto lines = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  require(error.where.line <= lines, "an error behind the last line: " + shown);
  require(error.where.column <= text.size() + 1, "an error behind the end: " + shown);
}

void check_scene_file(std::string_view text, const std::string& file, SceneFormat format,
                      bool lights_only) {
  for (const NumberMeaning meaning : {NumberMeaning::kDouble, NumberMeaning::kDecimal}) {
    ReadOptions options;
    // JSON says itself what its numbers mean; the other meaning is tried as well.
    if (format != SceneFormat::kJson || meaning == NumberMeaning::kDecimal) {
      options.numbers = meaning;
    }
    options.lights_only = lights_only;
    const auto result = parse_scene(std::string(text), file, options);
    if (!result) {
      check_error(result.error(), file, text, true);
      continue;
    }
    for (const std::string& warning : result->warnings) {
      require(!warning.empty() && warning.find('\n') == std::string::npos, "a warning of no line");
    }
    check_scene(result->scene, format, meaning, lights_only);
  }
}

std::string difference(const Scene& a, const Scene& b) {
  if (a.name != b.name) return "name";
  if (a.numbers != b.numbers) return "meaning of numbers";
  if (a.two_sided != b.two_sided) return "two-sidedness";
  if (a.vertices != b.vertices) return "vertices";
  if (a.polygons.size() != b.polygons.size()) return "number of polygons";
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    const Polygon &p = a.polygons[i], &q = b.polygons[i];
    if (p.id != q.id || p.loop != q.loop || p.holes != q.holes || p.two_sided != q.two_sided ||
        p.casts != q.casts) {
      return "polygon " + std::to_string(i);
    }
  }
  if (a.lights.size() != b.lights.size()) return "number of lights";
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    if (!same_light(a.lights[i], b.lights[i])) return "light " + std::to_string(i);
  }
  return {};
}

}  // namespace gnomon::fuzzers
