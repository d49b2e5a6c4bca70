// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/base/utf16.h"

#include <cstddef>
#include <cstdint>

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

constexpr std::uint32_t kLead = 0xD800, kTrail = 0xDC00, kBehindTrail = 0xE000;

void append_utf8(std::string& text, std::uint32_t character) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  const auto add_rest = [&](unsigned shift) { add(0x80u | (character >> shift & 0x3Fu)); };
  if (character < 0x80) {
    add(character);
  } else if (character < 0x800) {
    add(0xC0u | character >> 6);
    add_rest(0);
  } else if (character < 0x10000) {
    add(0xE0u | character >> 12);
    add_rest(6);
    add_rest(0);
  } else {
    add(0xF0u | character >> 18);
    add_rest(12);
    add_rest(6);
    add_rest(0);
  }
}

}  // namespace

bool is_utf16(std::string_view bytes) {
  if (bytes.starts_with("\xFE\xFF")) return true;
  // The mark of UTF-32 in little endian is that of UTF-16 and two zeros.
  return bytes.starts_with("\xFF\xFE") && bytes.substr(2, 2) != std::string_view("\0\0", 2);
}

Expected<std::string> utf8_of_utf16(std::string_view bytes, const std::string& file) {
  const std::size_t high = bytes.front() == '\xFE' ? 0 : 1;
  const auto unit = [&](std::size_t at) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + high])) << 8 |
           static_cast<unsigned char>(bytes[at + 1 - high]);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t at = 2; at < bytes.size(); at += 2) {
    std::uint32_t character = at + 1 < bytes.size() ? unit(at) : kTrail;
    if (character >= kLead && character < kTrail && at + 3 < bytes.size()) {
      const std::uint32_t trail = unit(at + 2);
      if (trail >= kTrail && trail < kBehindTrail) {
        character = 0x10000u + ((character - kLead) << 10) + (trail - kTrail);
        at += 2;
      }
    }
    if (character >= kLead && character < kBehindTrail) {
      return fail(ErrorCode::kSyntax, "this is half of a character of UTF-16",
                  "a file in UTF-8 or UTF-16", place_in_text(file, text, text.size()));
    }
    append_utf8(text, character);
  }
  return text;
}

}  // namespace gnomon
