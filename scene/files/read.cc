// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/read.h"

#include <algorithm>
#include <new>

#include "scene/base/text_file.h"
#include "scene/base/text_window.h"
#include "scene/files/formats.h"
#include "scene/files/plain_json_scene.h"
#include "scene/files/readers.h"

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

Expected<ReadResult> parse_scene(std::string text, const std::string& file,
                                 const ReadOptions& options) {
  std::optional<SceneFormat> format = options.format;
  if (!format && file == "<stdin>") format = SceneFormat::kJson;
  if (!format) format = format_by_extension(file);
  if (!format) format = format_by_content(text);
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
    return file_format(*format).read(text, file, options);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kLimit, "the scene does not fit into memory", {},
                ErrorPlace{file, 0, 0, {}});
  }
}

namespace {

/// A scene in plain JSON, without its text in memory.
std::optional<ReadResult> read_plain_file(const std::filesystem::path& path,
                                          const ReadOptions& options) {
  if (path == "-") return std::nullopt;
  const auto format = options.format ? options.format : format_by_extension(path);
  if (format != SceneFormat::kJson) return std::nullopt;
  auto window = TextWindow::of_file(path);
  if (!window) return std::nullopt;
  return read_plain_json(*window, shown_name(path), options);
}

}  // namespace

Expected<ReadResult> read_scene(const std::filesystem::path& path, const ReadOptions& options) {
  Expected<std::string> text;
  try {
    if (auto plain = read_plain_file(path, options)) return *std::move(plain);
    text = read_file(path);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kLimit, "the file does not fit into memory", {},
                ErrorPlace{shown_name(path), 0, 0, {}});
  }
  if (!text) return tl::unexpected(std::move(text.error()));
  return parse_scene(*std::move(text), shown_name(path), options);
}

}  // namespace gnomon
