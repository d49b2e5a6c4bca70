// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/scene_format.h"

#include <string>

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

struct FormatWord {
  SceneFormat format;
  std::string_view name;
};

constexpr FormatWord kFormats[] = {
    {SceneFormat::kJson, "json"},
    {SceneFormat::kObj, "obj"},
    {SceneFormat::kOff, "off"},
    {SceneFormat::kPlyAscii, "ply"},
    {SceneFormat::kPlyBinary, "ply-binary"},
};

/// Is the first word OFF with any of its prefixes?
bool begins_like_off(std::string_view text) {
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n#"));
  return word.size() >= 3 && word.size() <= 8 && word.ends_with("OFF") &&
         word.find_first_not_of("STCN4n") >= word.size() - 3;
}

/// Does one of the first lines begin with an OBJ keyword that has numbers?
bool begins_like_obj(std::string_view text) {
  constexpr std::size_t kFarEnough = std::size_t{1} << 16;
  text = text.substr(0, kFarEnough);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with("v ") || line.starts_with("v\t")) return true;
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return false;
}

}  // namespace

std::string_view format_name(SceneFormat format) {
  for (const FormatWord& known : kFormats) {
    if (known.format == format) return known.name;
  }
  return "";
}

std::optional<SceneFormat> format_by_name(std::string_view name) {
  for (const FormatWord& known : kFormats) {
    if (known.name == name) return known.format;
  }
  return std::nullopt;
}

std::optional<SceneFormat> format_by_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (extension.empty()) return std::nullopt;
  extension.erase(0, 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return format_by_name(extension);
}

std::optional<SceneFormat> format_by_content(std::string_view text) {
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return SceneFormat::kPlyAscii;
  text.remove_prefix(byte_order_mark(text));
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with("{")) return SceneFormat::kJson;
  if (begins_like_off(text)) return SceneFormat::kOff;
  if (begins_like_obj(text)) return SceneFormat::kObj;
  return std::nullopt;
}

}  // namespace gnomon
