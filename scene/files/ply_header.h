// SPDX-License-Identifier: LGPL-3.0-or-later
// The header of a PLY file: its encoding, and the elements and properties that follow.
#ifndef GNOMON_SCENE_FILES_PLY_HEADER_H
#define GNOMON_SCENE_FILES_PLY_HEADER_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"

namespace gnomon {

enum class PlyEncoding : std::uint8_t { kAscii, kLittleEndian, kBigEndian };

enum class PlyType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};

constexpr std::size_t ply_size(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kFloat64:
      return 8;
    default:
      return 4;
  }
}
constexpr bool is_integer(PlyType type) { return type < PlyType::kFloat32; }

struct PlyProperty {
  std::string_view name;
  PlyType type = PlyType::kInt8;
  std::optional<PlyType> list_count;  // set for a list: the type of its length
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::size_t offset = 0;  // of its line
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;  // in the order of the file; names point into the text
  std::size_t size = 0;              // the data begin here
};

/// Errors: kSyntax, kFormat; kFormat also if the elements announced cannot fit into the file.
Expected<PlyHeader> read_ply_header(std::string_view text, const std::string& file);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_PLY_HEADER_H
