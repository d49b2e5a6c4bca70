// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace gnomon::report {

std::string shortest(double value) {
  std::array<char, kLongestShortest> buffer;
  return {buffer.data(), write_shortest(buffer.data(), value)};
}

char* write_shortest(char* text, double value) {
  // The digits of a small integer are its shortest text, and are found sooner as such.
  constexpr double kSmall = 100'000;
  if (value >= 0 && value < kSmall) {
    const auto whole = static_cast<std::int32_t>(value);
    if (whole == value && !std::signbit(value)) {
      return std::to_chars(text, text + kLongestShortest, whole).ptr;
    }
  }
  return std::to_chars(text, text + kLongestShortest, value).ptr;
}

std::string rounded(double value, int digits) {
  std::array<char, 400> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::general, digits)
                       .ptr;
  return {buffer.data(), end};
}

std::string grouped(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3;) {
    at -= 3;
    text.insert(at, 1, ',');
  }
  return text;
}

std::string percent(double share) {
  if (!std::isfinite(share)) return "?";
  return rounded(100 * share, 3) + " %";
}

}  // namespace gnomon::report
