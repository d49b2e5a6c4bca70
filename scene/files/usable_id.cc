// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/usable_id.h"

#include <algorithm>

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

std::string escaped_bytes(std::string_view name, bool for_id) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string result;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t length = utf8_length(name, at);
    const auto byte = static_cast<unsigned char>(name[at]);
    // U+0080 to U+009F are control characters, too.
    const bool is_control =
        byte < 0x20 || byte == 0x7F ||
        (length == 2 && byte == 0xC2 && static_cast<unsigned char>(name[at + 1]) < 0xA0);
    const std::size_t count = std::max<std::size_t>(length, 1);
    if (length != 0 && !(for_id && (is_control || byte == '#'))) {
      result += name.substr(at, count);
    } else {
      for (std::size_t i = at; i < at + count; ++i) {
        const auto shown = static_cast<unsigned char>(name[i]);
        result += '%';
        result += kHex[shown >> 4];
        result += kHex[shown & 15];
      }
    }
    at += count;
  }
  return result;
}

}  // namespace

std::string usable_id(std::string_view name) { return escaped_bytes(name, true); }

std::string usable_text(std::string_view name) { return escaped_bytes(name, false); }

}  // namespace gnomon
