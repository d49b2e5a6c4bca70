// SPDX-License-Identifier: LGPL-3.0-or-later
// The JSON reader: what plain_json_scene.h does not take is one pass of RapidJSON's SAX parser into
// the scene; structure is checked afterwards by validate.h, and only then is a JSON pointer turned
// into a line, by a second pass over the text.
#include <rapidjson/reader.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "gnomon/scene/validate.h"
#include "scene/base/text_file.h"
#include "scene/files/json_dialect.h"
#include "scene/files/json_scene_handler.h"
#include "scene/files/left_out.h"
#include "scene/files/plain_json_scene.h"
#include "scene/files/readers.h"
#include "scene/json/json_text.h"

namespace gnomon {

namespace {

std::optional<Error> check_structure(const std::string& text, const Scene& scene,
                                     bool lights_only) {
  if (lights_only && !scene.polygons.empty()) {
    return Error{ErrorCode::kFormat, ErrorPlace{scene.file, 0, 0, "/polygons"},
                 "polygons in a file of lights", "lights only"};
  }
  auto valid = lights_only ? validate_lights(scene) : validate_scene(scene);
  if (valid) return std::nullopt;
  Error error = std::move(valid.error());
  error.where = place_in_text(scene.file, text, locate_pointer(text, error.where.pointer),
                              error.where.pointer);
  return error;
}

/// Polygons whose loops no scene can have, each with the line on which it begins.
std::vector<PolygonProblem> find_problems(const std::string& text, SceneHandler& handler) {
  std::vector<PolygonProblem> problems = std::move(handler.problems());
  const Scene& scene = handler.scene();
  const auto add = [&](std::size_t polygon, ErrorCode code, std::string what,
                       std::string expected) {
    problems.push_back(
        {static_cast<std::uint32_t>(polygon),
         Error{code, ErrorPlace{scene.file, 0, 0, {}}, std::move(what), std::move(expected)}});
  };
  const auto check = [&](std::size_t polygon, const std::vector<VertexId>& ring) {
    for (const VertexId vertex : ring) {
      const auto bad = handler.bad_vertices().find(vertex);
      if (vertex >= scene.vertices.size()) {
        add(polygon, ErrorCode::kIndex,
            "index " + std::to_string(vertex) + " is not that of a vertex", "an index of a vertex");
      } else if (bad != handler.bad_vertices().end()) {
        add(polygon, ErrorCode::kNumber, "vertex " + std::to_string(vertex) + ": " + bad->second,
            "finite numbers");
      }
    }
  };
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    if (polygon.loop.size() < 3) {
      add(i, ErrorCode::kFormat, "a loop of " + std::to_string(polygon.loop.size()) + " vertices",
          "at least 3 vertices");
    }
    check(i, polygon.loop);
    for (const auto& hole : polygon.holes) check(i, hole);
  }
  std::ranges::stable_sort(problems, {}, &PolygonProblem::polygon);
  PlacesInText places(text);
  for (PolygonProblem& problem : problems) {
    problem.error.where = places.at(scene.file, handler.polygon_offsets()[problem.polygon]);
  }
  return problems;
}

/// The rest of the scene is checked as it stands, with bad polygons as some triangle.
void make_harmless(Scene& scene, const std::vector<PolygonProblem>& problems) {
  for (const PolygonProblem& problem : problems) {
    scene.polygons[problem.polygon].loop = {0, 0, 0};
    scene.polygons[problem.polygon].holes.clear();
  }
}

}  // namespace

Likeness looks_like_json(std::string_view text) {
  return json_dialect(text) == SceneFormat::kJson ? Likeness::kCertain : Likeness::kNone;
}

Expected<ReadResult> read_json(const std::string& text, const std::string& file,
                               const ReadOptions& options) {
  // The plain reader knows neither places nor what to do with bad polygons.
  if (options.skip_bad || options.polygon_offsets) return parse_json(text, file, options);
  TextWindow window(text);
  if (auto plain = read_plain_json(window, file, options)) return *std::move(plain);
  return parse_json(text, file, options);
}

Expected<ReadResult> parse_json(const std::string& file_text, const std::string& file,
                                const ReadOptions& options) {
  if (auto readable = check_is_utf8(file_text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  const std::size_t start = byte_order_mark(file_text);
  NumberMeaning meaning = options.numbers.value_or(NumberMeaning::kDouble);
  bool meaning_is_fixed = options.numbers.has_value();
  LongNumbers long_numbers;
  std::string text_without_long_numbers;
  const std::string* text = &file_text;
  // Twice at most for a meaning found late, and once more for long numbers.
  for (;;) {
    rapidjson::StringStream stream(text->c_str() + start);
    SceneHandler handler(*text, file, start, stream, long_numbers, meaning, meaning_is_fixed,
                         options.lights_only);
    if (options.skip_bad) handler.skip_bad();
    rapidjson::Reader reader;
    const rapidjson::ParseResult parsed = reader.Parse<kJsonFlags>(stream, handler);
    if (handler.meaning_found_late()) {
      meaning = *handler.meaning_found_late();
      meaning_is_fixed = true;
      continue;
    }
    if (parsed.Code() == rapidjson::kParseErrorNumberTooBig && long_numbers.empty()) {
      text_without_long_numbers = file_text;
      text = &text_without_long_numbers;
      long_numbers.hide_in(text_without_long_numbers);
      if (!long_numbers.empty()) continue;
    }
    if (handler.error()) return tl::unexpected(*std::move(handler.error()));
    if (parsed.IsError()) {
      return tl::unexpected(json_syntax_error(parsed.Code(), *text, start + parsed.Offset(), file,
                                              handler.pointer()));
    }
    std::vector<PolygonProblem> problems;
    if (options.skip_bad) problems = find_problems(*text, handler);
    ReadResult result{std::move(handler.scene()), {}, {}, {}};
    make_harmless(result.scene, problems);
    if (!handler.has_name()) result.scene.name = name_from_file(file);
    if (auto error = check_structure(*text, result.scene, options.lights_only)) {
      return tl::unexpected(*std::move(error));
    }
    if (options.skip_bad || options.polygon_offsets) {
      result.polygon_offsets = std::move(handler.polygon_offsets());
    }
    leave_out(result, std::move(problems));
    handler.underflow().report(*text, result.warnings);
    if (!options.lights_only && result.scene.polygons.empty()) {
      result.warnings.emplace_back("the scene has no polygons");
    }
    return result;
  }
}

}  // namespace gnomon
