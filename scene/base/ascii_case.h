// SPDX-License-Identifier: LGPL-3.0-or-later
// Words of formats in which upper and lower case of ASCII letters are the same.
#ifndef GNOMON_SCENE_BASE_ASCII_CASE_H
#define GNOMON_SCENE_BASE_ASCII_CASE_H

#include <algorithm>
#include <string>
#include <string_view>

namespace gnomon {

constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// All other characters stay as they are.
inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower_case(c);
  return result;
}

/// Are they the same but for upper and lower case?
inline bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower_case(x) == lower_case(y); });
}

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_ASCII_CASE_H
