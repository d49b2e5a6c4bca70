// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/json/json_scanner.h"

#include "scene/base/text_file.h"

namespace gnomon {

bool JsonScanner::exponent(JsonNumber& value) {
  bool negative = false;
  if (*at_ == '+' || *at_ == '-') negative = *at_++ == '-';
  std::uint64_t magnitude = 0;
  const std::ptrdiff_t count = digits(magnitude);
  constexpr std::ptrdiff_t kFewDigits = 3;
  if (count > kFewDigits) {
    value.is_short = false;
  } else {
    const auto written = static_cast<std::int32_t>(magnitude);
    value.exponent += negative ? -written : written;
  }
  return count != 0;
}

bool JsonScanner::string(std::string_view& value) {
  using namespace eight_characters;
  if (!mark('"')) return false;
  const char* const begin = at_;
  for (;;) {
    while (end_ - at_ >= 8) {
      const std::uint64_t marks = not_plain(load_eight(at_));
      if (marks != 0) {
        at_ += bytes_below(marks);
        break;
      }
      at_ += 8;
    }
    const auto byte = static_cast<unsigned char>(*at_);
    if (byte == '"') break;
    if (byte < 0x20 || byte == '\\') return false;
    const std::size_t length =
        utf8_length(std::string_view(at_, static_cast<std::size_t>(end_ - at_)), 0);
    if (length == 0) return false;
    at_ += length;
  }
  value = std::string_view(begin, static_cast<std::size_t>(at_ - begin));
  ++at_;
  return true;
}

bool JsonScanner::value() {
  constexpr int kMostLevels = 64;
  std::uint64_t objects = 0;  // a bit for each open level, the innermost lowest
  int levels = 0;
  std::string_view text_value;
  JsonNumber number_value;
  bool truth_value = false;
  for (;;) {
    const char first = next();
    if (first == '{' || first == '[') {
      const bool object = first == '{';
      ++at_;
      if (!mark(object ? '}' : ']')) {
        if (++levels > kMostLevels) return false;
        objects = objects << 1 | (object ? 1 : 0);
        if (object && !key()) return false;
        continue;
      }
    } else if (!(first == '"'                   ? string(text_value)
                 : first == 'n'                 ? text("null")
                 : first == 't' || first == 'f' ? truth(truth_value)
                                                : number(number_value))) {
      return false;
    }
    for (;; objects >>= 1, --levels) {
      if (levels == 0) return true;
      const bool object = (objects & 1) != 0;
      char found = 0;
      if (!mark(',', object ? '}' : ']', found)) return false;
      if (found != ',') continue;
      if (object && !key()) return false;
      break;
    }
  }
}

}  // namespace gnomon
