// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/formats.h"

#include <algorithm>

#include "scene/base/ascii_case.h"
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
    {SceneFormat::kCityJson,  "cityjson",   "CityJSON",   "city.json",  Holds::kSurfaces,
     looks_like_cityjson, read_cityjson, write_cityjson},
    {SceneFormat::kCityJsonSeq, "cityjsonseq", "CityJSONSeq", "jsonl", Holds::kSurfaces,
     looks_like_cityjson_sequence, read_cityjson_sequence, nullptr, stream_cityjson_sequence},
    {SceneFormat::kEpJson, "epjson", "epJSON", "epjson", Holds::kSurfaces,
     looks_like_epjson, read_epjson, nullptr},
    {SceneFormat::kIdf, "idf", "IDF", "idf", Holds::kSurfaces,
     looks_like_idf, read_idf, nullptr},
    {SceneFormat::kHbJson, "hbjson", "HBJSON", "hbjson", Holds::kSurfaces,
     looks_like_hbjson, read_hbjson, nullptr},
    {SceneFormat::kGbXml, "gbxml", "gbXML", "xml", Holds::kSurfaces,
     looks_like_gbxml, read_gbxml, nullptr},
    {SceneFormat::kRadiance, "rad", "Radiance", "rad", Holds::kSurfaces,
     looks_like_radiance, read_radiance, nullptr},
    {SceneFormat::kGltf, "gltf", "glTF", "gltf", Holds::kMesh,
     looks_like_gltf, read_gltf, nullptr, nullptr, UpAxis::kY},
    {SceneFormat::kGlb, "glb", "binary glTF", "glb", Holds::kMesh,
     looks_like_glb, read_gltf, nullptr, nullptr, UpAxis::kY},
    {SceneFormat::kStl, "stl", "STL", "stl", Holds::kMesh,
     looks_like_stl, read_stl, nullptr},
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

std::string shown_written_extensions() {
  std::vector<std::string> there;
  for (const FileFormat& known : kFormats) {
    if (known.write != nullptr && known.looks_like != nullptr) {
      there.push_back("." + std::string(known.extension));
    }
  }
  std::string text = there.front();
  for (std::size_t i = 1; i < there.size(); ++i) {
    text += (i + 1 == there.size() ? " or " : ", ") + there[i];
  }
  return text;
}

std::vector<std::string> written_format_names() {
  std::vector<std::string> names;
  for (const FileFormat& known : kFormats) {
    if (known.write != nullptr) names.emplace_back(known.name);
  }
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
  const std::string name = lower_case(path.filename().string());
  // Of .json and .city.json the longer one counts.
  const FileFormat* longest = nullptr;
  for (const FileFormat& known : kFormats) {
    if (!name.ends_with("." + std::string(known.extension))) continue;
    if (longest == nullptr || known.extension.size() > longest->extension.size()) longest = &known;
  }
  return longest != nullptr ? std::optional(longest->format) : std::nullopt;
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
