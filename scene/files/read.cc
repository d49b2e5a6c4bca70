// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/read.h"

#include <algorithm>
#include <charconv>
#include <new>

#include "scene/base/text_file.h"
#include "scene/base/text_window.h"
#include "scene/files/foreign_formats.h"
#include "scene/files/formats.h"
#include "scene/files/json_dialect.h"
#include "scene/files/left_out.h"
#include "scene/files/plain_json_scene.h"
#include "scene/files/readers.h"
#include "scene/files/up_axis.h"
#include "scene/json/json_text.h"

namespace gnomon {

std::string name_from_file(const std::string& file) {
  if (file == "<stdin>") return "";
  std::string stem = std::filesystem::path(file).stem().string();
  // A file name may hold any bytes, a scene's name is UTF-8.
  if (!stem.empty() && !check_is_utf8(stem, file)) stem = "scene";
  return stem;
}

std::string_view first_word_on(std::string_view text) {
  text.remove_prefix(byte_order_mark(text));
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

void UnderflowCount::report(std::string_view text, std::vector<std::string>& warnings) const {
  if (count == 0) return;
  const ErrorPlace place = place_in_text({}, text, first_offset);
  warnings.push_back(std::to_string(count) + (count == 1 ? " number is" : " numbers are") +
                     " too small for full double precision; first at line " +
                     std::to_string(place.line) + ", column " + std::to_string(place.column));
}

namespace {

bool is_any_json(std::optional<SceneFormat> format) {
  return format == SceneFormat::kJson || format == SceneFormat::kCityJson ||
         format == SceneFormat::kCityJsonSeq || format == SceneFormat::kEpJson ||
         format == SceneFormat::kHbJson || format == SceneFormat::kGltf;
}

/// The scene with z up.
Expected<ReadResult> turned_up(Expected<ReadResult> read, SceneFormat format,
                               const ReadOptions& options) {
  if (read && options.up.value_or(file_format(format).up) == UpAxis::kY) turn_y_up(read->scene);
  return read;
}

Expected<ReadResult> parse_known_format(const std::string& text, const std::string& file,
                                        const ReadOptions& options) {
  std::optional<SceneFormat> format = options.format;
  if (!format && file == "<stdin>") format = SceneFormat::kJson;
  if (!format) format = format_by_extension(file);
  if (!format) format = format_by_content(text);
  if (!options.format && is_any_json(format)) {
    // Which JSON it is, no name tells for certain.
    const auto dialect = json_dialect(text);
    const bool is_sequence_of_none =
        format == SceneFormat::kCityJsonSeq && dialect == SceneFormat::kCityJson;
    if (dialect && *dialect != SceneFormat::kJson && !is_sequence_of_none) format = dialect;
  }
  if (!options.lod.empty() && format != SceneFormat::kCityJson &&
      format != SceneFormat::kCityJsonSeq) {
    return fail(ErrorCode::kUsage, file + ": --lod is for CityJSON alone");
  }
  if (options.lights_only && format && file_format(*format).holds != Holds::kScene) {
    return fail(ErrorCode::kFormat, "lights come from JSON only", "a scene file with lights",
                ErrorPlace{file, 0, 0, {}});
  }
  if (!format) {
    if (auto readable = check_is_text(text, file); !readable) {
      return tl::unexpected(std::move(readable.error()));
    }
    return fail(ErrorCode::kFormat, "neither the name nor the content tells the format",
                shown_format_titles(), ErrorPlace{file, 0, 0, {}});
  }
  try {
    return turned_up(file_format(*format).read(text, file, options), *format, options);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kLimit, "the scene does not fit into memory", {},
                ErrorPlace{file, 0, 0, {}});
  }
}

/// A scene in plain JSON, without its text in memory.
std::optional<ReadResult> read_plain_file(const std::filesystem::path& path,
                                          const ReadOptions& options) {
  if (path == "-" || options.skip_bad || options.polygon_offsets) return std::nullopt;
  const auto format = options.format ? options.format : format_by_extension(path);
  if (format != SceneFormat::kJson) return std::nullopt;
  auto window = TextWindow::of_file(path);
  if (!window) return std::nullopt;
  return read_plain_json(*window, shown_name(path), options);
}

/// A file of a format that need not be in memory as a whole.
std::optional<Expected<ReadResult>> read_streamed_file(const std::filesystem::path& path,
                                                       const ReadOptions& options) {
  if (path == "-" || options.skip_bad || options.polygon_offsets || options.lights_only) {
    return std::nullopt;
  }
  const auto format = options.format ? options.format : format_by_extension(path);
  if (!format || file_format(*format).stream == nullptr) return std::nullopt;
  auto window = TextWindow::of_file(path);
  if (!window) return std::nullopt;
  return turned_up(file_format(*format).stream(*window, shown_name(path), options), *format,
                   options);
}

}  // namespace

Expected<ReadResult> parse_scene(std::string text, const std::string& file,
                                 const ReadOptions& options) {
  auto result = parse_known_format(text, file, options);
  if (result) {
    if (!options.skip_bad || options.lights_only) return result;
    if (auto done = leave_out_unusable(*result, text); !done) {
      return tl::unexpected(std::move(done.error()));
    }
    return result;
  }
  const ErrorCode code = result.error().code;
  if (code != ErrorCode::kSyntax && code != ErrorCode::kFormat) return result;
  // An OFF or PLY file is one, whatever words it holds; JSON is of many formats.
  const auto own = format_by_content(text);
  const auto named = options.format ? options.format : format_by_extension(file);
  if (own && named && !is_any_json(named) && *own != *named &&
      (file_format(*own).holds == Holds::kSurfaces || file_format(*own).up == UpAxis::kY ||
       *own == SceneFormat::kStl)) {
    return fail(ErrorCode::kFormat,
                "this is " + std::string(file_format(*own).title) + ", and called " +
                    std::string(file_format(*named).title),
                "a name that ends in ." + std::string(file_format(*own).extension),
                ErrorPlace{file, 0, 0, {}});
  }
  if (own && *own != SceneFormat::kJson && *own != SceneFormat::kObj) return result;
  const auto foreign = foreign_format(text);
  if (!foreign) return result;
  return fail(ErrorCode::kFormat, "this is " + std::string(*foreign) + ", which is not read here",
              shown_format_titles() + "; JSON is a scene of gnomon's own",
              ErrorPlace{file, 0, 0, {}});
}

Expected<ReadResult> read_scene(const std::filesystem::path& path, const ReadOptions& options) {
  Expected<std::string> text;
  try {
    if (auto plain = read_plain_file(path, options)) {
      return turned_up(*std::move(plain), SceneFormat::kJson, options);
    }
    if (auto streamed = read_streamed_file(path, options)) return *std::move(streamed);
    text = read_file(path);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kLimit, "the file does not fit into memory", {},
                ErrorPlace{shown_name(path), 0, 0, {}});
  }
  if (!text) return tl::unexpected(std::move(text.error()));
  return parse_scene(*std::move(text), shown_name(path), options);
}

Error with_line_of_polygon(Error error, const std::filesystem::path& path,
                           const ReadOptions& options) {
  constexpr std::string_view kList = "/polygons/";
  const std::string_view pointer = error.where.pointer;
  if (path == "-" || error.where.line != 0 || !pointer.starts_with(kList)) return error;
  std::size_t index = 0;
  const char* const digits = pointer.data() + kList.size();
  const auto [end, failure] = std::from_chars(digits, pointer.data() + pointer.size(), index);
  if (failure != std::errc{}) return error;
  auto text = read_file(path);
  if (!text) return error;
  ReadOptions with_offsets = options;
  with_offsets.polygon_offsets = true;
  const auto again = parse_known_format(*text, shown_name(path), with_offsets);
  if (!again || index >= again->polygon_offsets.size()) return error;
  const bool is_json = json_dialect(*text) == SceneFormat::kJson;
  // In a scene of our own the pointer goes on to the loop or the hole.
  const std::size_t offset =
      is_json ? locate_pointer(*text, error.where.pointer) : again->polygon_offsets[index];
  error.where = place_in_text(error.where.file, *text, offset,
                              is_json ? std::move(error.where.pointer) : std::string());
  return error;
}

}  // namespace gnomon
