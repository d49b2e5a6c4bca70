// SPDX-License-Identifier: LGPL-3.0-or-later
// Errors in words, in the one form that the command line prints.
#include "gnomon/kernel/error.h"

namespace gnomon {

namespace {

/// The pointer on one line: keys of a file may hold anything, such as what a terminal obeys.
std::string shown_pointer(const std::string& pointer) {
  constexpr std::size_t kMostShown = 200;
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string text;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    const auto byte = static_cast<unsigned char>(pointer[i]);
    const bool begins_character = (byte & 0xC0) != 0x80;
    if (i >= kMostShown && begins_character) return text + "...";
    // The controls beyond ASCII are C2 80 to C2 9F.
    const bool control = byte < 0x20 || byte == 0x7F ||
                         (byte == 0xC2 && i + 1 < pointer.size() &&
                          static_cast<unsigned char>(pointer[i + 1]) < 0xA0);
    if (!control) {
      text += pointer[i];
      continue;
    }
    const auto code = byte == 0xC2 ? static_cast<unsigned char>(pointer[++i]) : byte;
    text += "\\x";
    text += kHex[code >> 4];
    text += kHex[code & 15];
  }
  return text;
}

}  // namespace

std::string to_string(const Error& error) {
  std::string text = error.where.file;
  if (error.where.line > 0) {
    if (!text.empty()) text += ':';
    text += std::to_string(error.where.line);
    if (error.where.column > 0) text += ':' + std::to_string(error.where.column);
  }
  if (!text.empty()) text += ": ";
  text += error.what;
  if (!error.expected.empty()) text += "; expected " + error.expected;
  if (!error.where.pointer.empty()) text += " (at " + shown_pointer(error.where.pointer) + ")";
  return text;
}

}  // namespace gnomon
