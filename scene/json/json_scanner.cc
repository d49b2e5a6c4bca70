// SPDX-License-Identifier: LGPL-3.0-or-later
// Digits and characters are looked at eight at a time, as the bytes of one integer: numbers of
// different lengths then take one way through the code, where a loop over their digits would be
// mispredicted at each end.
#include "scene/json/json_scanner.h"

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

constexpr std::uint64_t kEveryByte = 0x0101010101010101u;
constexpr std::uint64_t kHighBits = 0x80 * kEveryByte;

/// Eight bytes, the first of them lowest.
std::uint64_t load(const char* at) {
  std::uint64_t word = 0;
  std::memcpy(&word, at, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  return word;
}

/// The number of bytes below the lowest one that is marked by its high bit.
std::ptrdiff_t bytes_below(std::uint64_t marks) { return std::countr_zero(marks) >> 3; }

/// Marks bytes that are no decimal digits, given the text XOR "00000000"; exact up to the lowest.
std::uint64_t no_digits(std::uint64_t word) {
  return ((word + 0x76 * kEveryByte) | word) & kHighBits;
}

/// The number whose decimal digits are the bytes of a word, the first digit lowest.
std::uint64_t value_of_digits(std::uint64_t word) {
  word = (word * 10 + (word >> 8)) & 0x00ff00ff00ff00ffu;
  word = (word * 100 + (word >> 16)) & 0x0000ffff0000ffffu;
  return (word * 10000 + (word >> 32)) & 0xffffffffu;
}

/// Marks the bytes at which the run of a string's plain characters ends: the quote, a backslash,
/// control characters and whatever is not ASCII; exact up to the lowest.
std::uint64_t not_plain(std::uint64_t word) {
  const auto equal = [word](unsigned char c) {
    const std::uint64_t difference = word ^ (c * kEveryByte);
    return (difference - kEveryByte) & ~difference;
  };
  return (equal('"') | equal('\\') | ((word - 0x20 * kEveryByte) & ~word) | word) & kHighBits;
}

constexpr std::uint64_t kPowersOfTen[] = {1,      10,      100,      1000,     10000,
                                          100000, 1000000, 10000000, 100000000};

}  // namespace

std::ptrdiff_t JsonScanner::digits(std::uint64_t& value) {
  const char* const first = at_;
  while (end_ - at_ >= 8) {
    const std::uint64_t word = load(at_) ^ ('0' * kEveryByte);
    const std::uint64_t marks = no_digits(word);
    if (marks == 0) {
      value = value * kPowersOfTen[8] + value_of_digits(word);
      at_ += 8;
      continue;
    }
    const std::ptrdiff_t count = bytes_below(marks);
    // Zeros come in before the digits.
    if (count != 0) value = value * kPowersOfTen[count] + value_of_digits(word << (64 - 8 * count));
    at_ += count;
    return at_ - first;
  }
  for (; is_digit(*at_); ++at_) value = value * 10 + static_cast<std::uint64_t>(*at_ - '0');
  return at_ - first;
}

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

bool JsonScanner::number(JsonNumber& value) {
  skip_blanks();
  const char* const begin = at_;
  const bool negative = *at_ == '-';
  if (negative) ++at_;
  const char* const first = at_;
  std::uint64_t magnitude = 0;
  std::ptrdiff_t count = digits(magnitude);
  if (count == 0 || (count > 1 && *first == '0')) return false;
  value.exponent = 0;
  value.is_short = true;
  if (*at_ == '.') {
    ++at_;
    const std::ptrdiff_t places = digits(magnitude);
    if (places == 0) return false;
    count += places;
    value.exponent = -static_cast<std::int32_t>(places);
  }
  if (*at_ == 'e' || *at_ == 'E') {
    ++at_;
    if (!exponent(value)) return false;
  }
  value.is_short = value.is_short && count <= JsonNumber::kMostShortDigits;
  const auto mantissa = static_cast<std::int64_t>(value.is_short ? magnitude : 0);
  value.mantissa = negative ? -mantissa : mantissa;
  value.text = std::string_view(begin, static_cast<std::size_t>(at_ - begin));
  return true;
}

bool JsonScanner::index(std::uint32_t& value) {
  skip_blanks();
  const char* const first = at_;
  std::uint64_t wide = 0;
  const std::ptrdiff_t count = digits(wide);
  constexpr std::ptrdiff_t kMostDigits = 10;
  value = static_cast<std::uint32_t>(wide);
  return count != 0 && count <= kMostDigits && value == wide && (count == 1 || *first != '0');
}

bool JsonScanner::string(std::string_view& value) {
  if (!mark('"')) return false;
  const char* const begin = at_;
  for (;;) {
    while (end_ - at_ >= 8) {
      const std::uint64_t marks = not_plain(load(at_));
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
