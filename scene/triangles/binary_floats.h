// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers of binary files, whose low bytes come first whatever the machine does.
#ifndef GNOMON_SCENE_TRIANGLES_BINARY_FLOATS_H
#define GNOMON_SCENE_TRIANGLES_BINARY_FLOATS_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon {

/// An unsigned integer of so many bytes, at most 8. Requires: they are there.
inline std::uint64_t little_endian(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  }
  return value;
}

/// Requires: 4 bytes are there.
inline float little_endian_float(std::string_view bytes, std::size_t at) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(little_endian(bytes, at, 4)));
}

}  // namespace gnomon

#endif  // GNOMON_SCENE_TRIANGLES_BINARY_FLOATS_H
