// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/meshes/glb.h"

#include <cstdint>

#include "report/text/little_endian.h"

namespace gnomon::report {

std::string glb_file(std::string json, const std::string& bytes) {
  while (json.size() % 4 != 0) json += ' ';
  const bool has_buffer = !bytes.empty();
  std::string text = "glTF";
  append_little_endian(text, std::uint32_t{2});
  append_little_endian(
      text, static_cast<std::uint32_t>(12 + 8 + json.size() + (has_buffer ? 8 + bytes.size() : 0)));
  append_little_endian(text, static_cast<std::uint32_t>(json.size()));
  text += "JSON";
  text += json;
  if (has_buffer) {
    append_little_endian(text, static_cast<std::uint32_t>(bytes.size()));
    text.append("BIN\0", 4);
    text += bytes;
  }
  return text;
}

}  // namespace gnomon::report
