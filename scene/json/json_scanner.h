// SPDX-License-Identifier: LGPL-3.0-or-later
// Tokens of plain JSON, several times as fast as by the parser: strings without escapes, short
// numbers already taken apart. Who meets anything else gives up and has the text parsed.
//
// Every function takes blanks before its token, returns false if it is another one, and leaves the
// place where it failed. What it took is then JSON by the grammar.
#ifndef GNOMON_SCENE_JSON_JSON_SCANNER_H
#define GNOMON_SCENE_JSON_JSON_SCANNER_H

#include <cstdint>
#include <cstring>
#include <string_view>

#include "scene/base/text_window.h"
#include "scene/json/eight_characters.h"

namespace gnomon {

/// A number of JSON's grammar. If it has at most kMostShortDigits digits and an exponent of few, it
/// is +-mantissa * 10^exponent.
struct JsonNumber {
  static constexpr int kMostShortDigits = 18;
  std::string_view text;
  bool is_short = false;
  std::int64_t mantissa = 0;
  std::int32_t exponent = 0;
};

class JsonScanner {
 public:
  explicit JsonScanner(TextWindow& window)
      : window_(window), at_(window.begin()), end_(window.end()) {}

  /// Calls f, which takes tokens and returns false if they are others. If f failed at the end of
  /// the window the window moves on and f is called again, from where it began. So f must do
  /// nothing that cannot be done twice before it has taken all, and must end with a token that no
  /// further byte can lengthen: any but a number.
  template <class F>
  bool take(const F& f) {
    for (;;) {
      const char* const begin = at_;
      if (f()) return true;
      // The longest word that is compared at once, and more.
      constexpr std::ptrdiff_t kLongestWord = 16;
      if (end_ - at_ > kLongestWord || !window_.move_on(begin)) return false;
      at_ = window_.begin();
      end_ = window_.end();
    }
  }

  /// The bytes that are still to be scanned.
  std::size_t bytes_left() const {
    return window_.bytes_left() - static_cast<std::size_t>(at_ - window_.begin());
  }
  const char* place() const { return at_; }
  void skip_byte_order_mark() {
    if (std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with("\xEF\xBB\xBF")) {
      at_ += 3;
    }
  }
  /// Nothing but blanks up to the end of the text?
  bool at_end() {
    for (;;) {
      skip_blanks();
      if (at_ != end_) return false;
      if (!window_.move_on(at_)) return window_.is_whole();
      at_ = window_.begin();
      end_ = window_.end();
    }
  }

  bool mark(char c) {
    skip_blanks();
    if (*at_ != c) return false;
    ++at_;
    return true;
  }
  /// One of two marks.
  bool mark(char a, char b, char& found) {
    skip_blanks();
    found = *at_;
    if (found != a && found != b) return false;
    ++at_;
    return true;
  }
  /// The character that the next token begins with.
  char next() {
    skip_blanks();
    return *at_;
  }
  /// These very characters, such as a word or a string with its quotes.
  template <std::size_t size>
  bool text(const char (&wanted)[size]) {
    skip_blanks();
    if (end_ - at_ < static_cast<std::ptrdiff_t>(size - 1) ||
        std::memcmp(at_, wanted, size - 1) != 0) {
      return false;
    }
    at_ += size - 1;
    return true;
  }
  bool truth(bool& value) {
    value = text("true");
    return value || text("false");
  }
  /// A string in valid UTF-8 without escapes and control characters; `value` lies in the window.
  bool string(std::string_view& value);
  bool number(JsonNumber& value);
  /// A number without a point or an exponent and of less than eight digits, as most are. Otherwise
  /// nothing is taken.
  bool short_integer(std::int32_t& value);
  /// An integer from 0 to 2^32 - 1, without a point or an exponent.
  bool index(std::uint32_t& value);
  /// Any value, with arrays and objects inside one another to a small depth.
  bool value();

 private:
  static bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  void skip_blanks() {
    while (is_blank(*at_)) ++at_;
  }
  /// Takes digits, says how many, and appends them to those of `value` (modulo 2^64).
  std::ptrdiff_t digits(std::uint64_t& value);
  bool exponent(JsonNumber& value);
  bool key() {
    std::string_view name;
    return string(name) && mark(':');
  }

  TextWindow& window_;
  const char* at_;
  const char* end_;  // a NUL, which no token holds
};

inline std::ptrdiff_t JsonScanner::digits(std::uint64_t& value) {
  using namespace eight_characters;
  const char* const first = at_;
  while (end_ - at_ >= 8) {
    const std::uint64_t word = load_eight(at_) ^ ('0' * kEveryByte);
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

inline bool JsonScanner::short_integer(std::int32_t& value) {
  using namespace eight_characters;
  skip_blanks();
  const bool negative = *at_ == '-';
  const char* const first = at_ + (negative ? 1 : 0);
  if (end_ - first < 8) return false;
  const std::uint64_t word = load_eight(first) ^ ('0' * kEveryByte);
  const std::uint64_t marks = no_digits(word);
  if (marks == 0) return false;
  const std::ptrdiff_t count = bytes_below(marks);
  const char after = first[count];
  if (count == 0 || (count > 1 && *first == '0') || after == '.' || (after | 0x20) == 'e') {
    return false;
  }
  const auto magnitude = static_cast<std::int32_t>(value_of_digits(word << (64 - 8 * count)));
  value = negative ? -magnitude : magnitude;
  at_ = first + count;
  return true;
}

inline bool JsonScanner::number(JsonNumber& value) {
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

inline bool JsonScanner::index(std::uint32_t& value) {
  skip_blanks();
  const char* const first = at_;
  std::uint64_t wide = 0;
  const std::ptrdiff_t count = digits(wide);
  constexpr std::ptrdiff_t kMostDigits = 10;
  value = static_cast<std::uint32_t>(wide);
  return count != 0 && count <= kMostDigits && value == wide && (count == 1 || *first != '0');
}

}  // namespace gnomon

#endif  // GNOMON_SCENE_JSON_JSON_SCANNER_H
