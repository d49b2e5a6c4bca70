// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/formats.h"

#include <algorithm>

#include "scene/files/readers.h"
#include "scene/files/writers.h"

namespace gnomon {

namespace {

// clang-format off
constexpr FileFormat kFormats[] = {
    {SceneFormat::kJson,      "json",       "JSON",       "json",       Holds::kScene,
     looks_like_json, read_json, write_json},
    {SceneFormat::kObj,       "obj",        "OBJ",        "obj",        Holds::kMesh,
     looks_like_obj,  read_obj,  write_obj},
    {SceneFormat::kOff,       "off",        "OFF",        "off",        Holds::kMesh,
     looks_like_off,  read_off,  write_off},
    {SceneFormat::kPlyAscii,  "ply",        "PLY",        "ply",        Holds::kMesh,
     looks_like_ply,  read_ply,  write_ply_ascii},
    {SceneFormat::kPlyBinary, "ply-binary", "binary PLY", "ply-binary", Holds::kMeshOfDoubles,
     nullptr,         read_ply,  write_ply_binary},
};
// clang-format on

/// "a, b or c" of what `word` says of each format that files can be recognized as.
template <class Word>
std::string alternatives(const Word& word) {
  std::string text;
  std::string last;
  for (const FileFormat& format : kFormats) {
    if (format.looks_like == nullptr) continue;
    if (!last.empty()) text += (text.empty() ? "" : ", ") + last;
    last = word(format);
  }
  return text.empty() ? last : text + " or " + last;
}

}  // namespace

std::span<const FileFormat> file_formats() { return kFormats; }

const FileFormat& file_format(SceneFormat format) {
  return *std::ranges::find(kFormats, format, &FileFormat::format);
}

std::string shown_format_titles() {
  return alternatives([](const FileFormat& format) { return std::string(format.title); });
}

std::string shown_scene_extensions() {
  return alternatives([](const FileFormat& format) { return "." + std::string(format.extension); });
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const FileFormat& known : kFormats) names.emplace_back(known.name);
  return names;
}

std::string_view format_name(SceneFormat format) { return file_format(format).name; }

std::optional<SceneFormat> format_by_name(std::string_view name) {
  for (const FileFormat& known : kFormats) {
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
  for (const FileFormat& known : kFormats) {
    if (known.extension == extension) return known.format;
  }
  return std::nullopt;
}

std::optional<SceneFormat> format_by_content(std::string_view text) {
  std::optional<SceneFormat> possible;
  for (const FileFormat& known : kFormats) {
    if (known.looks_like == nullptr) continue;
    const Likeness likeness = known.looks_like(text);
    if (likeness == Likeness::kCertain) return known.format;
    if (likeness == Likeness::kPossible && !possible) possible = known.format;
  }
  return possible;
}

}  // namespace gnomon
