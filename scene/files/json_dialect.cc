// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/json_dialect.h"

#include "scene/files/readers.h"

namespace gnomon {

namespace {

/// Is this key, with its quotes, followed by a colon anywhere?
bool has_key(std::string_view text, std::string_view quoted_key) {
  for (std::size_t at = text.find(quoted_key); at != std::string_view::npos;
       at = text.find(quoted_key, at + 1)) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", at + quoted_key.size());
    if (next != std::string_view::npos && text[next] == ':') return true;
  }
  return false;
}

/// Classes of objects of which an energy model that has surfaces has some.
constexpr std::string_view kEnergyKeys[] = {"\"BuildingSurface:Detailed\"",
                                            "\"GlobalGeometryRules\"", "\"Shading:Site:Detailed\"",
                                            "\"Shading:Building:Detailed\""};

/// Types of which a building model of honeybee has some.
constexpr std::string_view kHoneybeeWords[] = {"\"ModelProperties\"", "\"Face3D\"", "\"ShadeMesh\"",
                                               "\"ModelEnergyProperties\""};

}  // namespace

std::optional<SceneFormat> json_dialect(std::string_view text) {
  if (!first_word_on(text).starts_with("{")) return std::nullopt;
  if (text.find("\"gnomon-") != std::string_view::npos) return SceneFormat::kJson;
  if (has_key(text, "\"CityObjects\"")) {
    return text.find("\"CityJSONFeature\"") != std::string_view::npos ? SceneFormat::kCityJsonSeq
                                                                      : SceneFormat::kCityJson;
  }
  for (const std::string_view key : kEnergyKeys) {
    if (has_key(text, key)) return SceneFormat::kEpJson;
  }
  for (const std::string_view word : kHoneybeeWords) {
    if (text.find(word) != std::string_view::npos) return SceneFormat::kHbJson;
  }
  if (has_key(text, "\"asset\"") && has_key(text, "\"version\"")) return SceneFormat::kGltf;
  return SceneFormat::kJson;
}

}  // namespace gnomon
