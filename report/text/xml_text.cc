// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/xml_text.h"

#include <algorithm>

#include "scene/base/text_file.h"

namespace gnomon::report {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// XML 1.0 has no control characters but these, and neither U+FFFE nor U+FFFF.
bool is_xml(std::string_view character) {
  const char first = character.front();
  if (character.size() == 1) {
    return static_cast<unsigned char>(first) >= 0x20 || first == '\t' || first == '\n' ||
           first == '\r';
  }
  return character != "\xEF\xBF\xBE" && character != "\xEF\xBF\xBF";
}

}  // namespace

void append_xml(std::string& to, std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(text, at));
    const std::string_view character = text.substr(at, length);
    at += length;
    switch (character.front()) {
      case '&':
        to += "&amp;";
        break;
      case '<':
        to += "&lt;";
        break;
      case '>':
        to += "&gt;";
        break;
      case '"':
        to += "&quot;";
        break;
      case '\n':
        to += "&#10;";
        break;
      default: {
        const bool broken = length == 1 && (character.front() & '\x80') != 0;
        to += broken || !is_xml(character) ? kReplacement : character;
      }
    }
  }
}

std::string xml_text(std::string_view text) {
  std::string result;
  append_xml(result, text);
  return result;
}

}  // namespace gnomon::report
