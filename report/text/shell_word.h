// SPDX-License-Identifier: GPL-3.0-or-later
// Words of commands that people are to paste into a shell.
#ifndef GNOMON_REPORT_TEXT_SHELL_WORD_H
#define GNOMON_REPORT_TEXT_SHELL_WORD_H

#include <algorithm>
#include <string>
#include <string_view>

namespace gnomon::report {

/// The word as a POSIX shell takes it: in quotes unless all of it means itself.
inline std::string shell_word(std::string_view word) {
  const auto means_itself = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           std::string_view("-_+=:,./").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, means_itself)) return std::string(word);
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') {
      text += "'\\''";
    } else {
      text += c;
    }
  }
  return text + '\'';
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_SHELL_WORD_H
