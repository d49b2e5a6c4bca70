// SPDX-License-Identifier: LGPL-3.0-or-later
// The file formats of scenes, by name, by extension and by content.
#ifndef GNOMON_SCENE_SCENE_FORMAT_H
#define GNOMON_SCENE_SCENE_FORMAT_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// For reading, the two kinds of PLY are one: the file says which it is.
enum class SceneFormat : std::uint8_t {
  kJson,
  kObj,
  kOff,
  kPlyAscii,
  kPlyBinary,
  kCityJson,
  kCityJsonSeq,
  kEpJson,
  kIdf,
  kHbJson,
  kGbXml,
  kRadiance,
  kGltf,
  kGlb,
  kStl,
};

/// "json", "obj", "off", "ply" (ascii), "ply-binary", "cityjson", "cityjsonseq", "epjson", "idf",
/// "hbjson", "gbxml", "rad", "gltf", "glb" (binary glTF), "stl".
std::string_view format_name(SceneFormat format);
/// The names of all formats that can be written.
std::vector<std::string> written_format_names();
/// The extensions of scene files, for messages: ".json, .obj, .off, ... or .idf"; and of those that
/// can be written.
std::string shown_scene_extensions();
std::string shown_written_extensions();

std::optional<SceneFormat> format_by_name(std::string_view name);
/// The format of .json, .obj, .off, ..., in upper or lower case. CityJSON, epJSON and HBJSON may
/// be in files called .json, too.
std::optional<SceneFormat> format_by_extension(const std::filesystem::path& path);
/// The format that the first bytes fit; nothing if they fit none.
std::optional<SceneFormat> format_by_content(std::string_view text);

}  // namespace gnomon

#endif  // GNOMON_SCENE_SCENE_FORMAT_H
