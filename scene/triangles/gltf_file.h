// SPDX-License-Identifier: LGPL-3.0-or-later
// The container of glTF 2.0: its JSON, which may be the first chunk of a binary file, and its
// buffers, whether in that file, in the JSON or in files beside it. Read by hand: tinygltf turns
// every number of the JSON into a double, opens whatever file a buffer names, and its errors tell
// no place.
#ifndef GNOMON_SCENE_TRIANGLES_GLTF_FILE_H
#define GNOMON_SCENE_TRIANGLES_GLTF_FILE_H

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/json/json_tape.h"

namespace gnomon {

/// The two chunks of a file: all of it, if it is JSON.
struct GltfChunks {
  std::string json;
  std::string_view binary;
};
/// Errors: kSyntax, with a byte.
Expected<GltfChunks> gltf_chunks(const std::string& text, const std::string& file);

/// A list of elements of a buffer.
struct GltfAccessor {
  std::string_view bytes;  // from the first element on
  std::size_t count = 0, stride = 0;
  std::uint32_t component_type = 0;
};

class GltfFile {
 public:
  /// All must outlive this.
  GltfFile(const JsonTape& tape, std::string_view binary, const std::string& file)
      : tape_(tape), binary_(binary), file_(file) {}
  /// Finds the lists and the buffers. Errors: kFormat, kFile, kSyntax.
  Expected<void> open();

  const JsonTape& tape() const { return tape_; }
  /// The object that `owner` names by its index under `key`, in a list of that name at the root.
  /// Errors: kFormat, kIndex.
  Expected<JsonNode> element(const JsonNode& index, std::string_view list) const;
  Expected<std::size_t> index(const JsonNode& number) const;
  /// A member that is a number from 0 on; nothing if it is missing.
  Expected<std::optional<std::size_t>> count(const JsonNode& object, std::string_view key) const;

  /// Positions: three floats each. Errors: kFormat, kIndex.
  Expected<GltfAccessor> positions(const JsonNode& index) const;
  /// Indices of 1, 2 or 4 bytes. Errors: the same.
  Expected<GltfAccessor> indices(const JsonNode& index) const;

 private:
  Expected<GltfAccessor> accessor(const JsonNode& index, std::string_view type,
                                  std::size_t components) const;
  Expected<std::string> load(const JsonNode& uri) const;

  const JsonTape& tape_;
  std::string_view binary_;
  const std::string& file_;
  std::map<std::string, std::vector<JsonNode>, std::less<>> lists_;  // of the root, by name
  std::vector<std::string> loaded_;  // buffers, where they are not in the file
  std::vector<std::string_view> buffers_;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_TRIANGLES_GLTF_FILE_H
