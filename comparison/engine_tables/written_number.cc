// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/engine_tables/written_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "report/text/number_text.h"
#include "scene/base/ascii_case.h"

namespace gnomon::comparison {

namespace {

// A code: whether it is an index, then decimals, then all digits as one integer.
constexpr unsigned kDigitBits = 27;
constexpr std::uint32_t kIsIndex = std::uint32_t{1} << 31;
constexpr std::uint32_t kMostMantissa = (std::uint32_t{1} << kDigitBits) - 1;
constexpr std::int32_t kMostDecimals = 15;
/// Exact as doubles, so that a quotient is the double nearest to a decimal.
constexpr std::array<double, kMostDecimals + 1> kPowers{
    1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::int32_t digit_count(std::uint32_t mantissa) {
  std::int32_t count = 0;
  for (; mantissa != 0; mantissa /= 10) ++count;
  return count;
}

std::optional<WrittenNumber> parse_word(std::string_view text, bool negative) {
  WrittenNumber number;
  if (same_word(text, "nan")) {
    number.value = std::numeric_limits<double>::quiet_NaN();
  } else if (same_word(text, "inf") || same_word(text, "infinity")) {
    number.value = std::numeric_limits<double>::infinity() * (negative ? -1 : 1);
  } else {
    return std::nullopt;
  }
  return number;
}

/// The digits of "d.d"; false if there are none.
bool count_digits(std::string_view text, std::size_t& at, WrittenNumber& number) {
  bool any = false, point = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '.' && !point) {
      point = true;
      continue;
    }
    if (!is_digit(c)) break;
    any = true;
    if (point) ++number.decimals;
    if (number.digits > 0 || c != '0') ++number.digits;
  }
  return any;
}

}  // namespace

std::optional<WrittenNumber> parse_written(std::string_view text) {
  // More digits than anyone writes would overflow the counts.
  constexpr std::size_t kLongest = 2000;
  if (text.empty() || text.size() > kLongest) return std::nullopt;
  const bool negative = text.front() == '-';
  std::string_view rest = text;
  if (negative || text.front() == '+') rest.remove_prefix(1);
  WrittenNumber number;
  std::size_t at = 0;
  if (!count_digits(rest, at, number)) return parse_word(rest, negative);
  if (at < rest.size()) {
    if (rest[at] != 'e' && rest[at] != 'E') return std::nullopt;
    number.has_exponent = true;
    std::string_view exponent = rest.substr(at + 1);
    if (!exponent.empty() && exponent.front() == '+') exponent.remove_prefix(1);
    std::int32_t power = 0;
    const char* const end = exponent.data() + exponent.size();
    const auto read = std::from_chars(exponent.data(), end, power);
    if (read.ec != std::errc() || read.ptr != end || power < -1000 || power > 1000) {
      return std::nullopt;
    }
    number.decimals -= power;
  }
  const std::string_view unsigned_or_minus = negative ? text : rest;
  const char* const end = unsigned_or_minus.data() + unsigned_or_minus.size();
  const auto read = std::from_chars(unsigned_or_minus.data(), end, number.value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return number;
}

std::string text_of(const WrittenNumber& number) {
  if (!std::isfinite(number.value) || number.has_exponent || number.digits > kMostDecimals ||
      number.decimals > kMostDecimals) {
    return report::shortest(number.value);
  }
  return fmt::format("{:.{}f}", number.value, number.decimals);
}

void WrittenDigits::add(const WrittenNumber& number) {
  if (number.has_exponent) return;
  most_decimals_ = std::max(most_decimals_, number.decimals);
  most_digits_ = std::max(most_digits_, number.digits);
}

bool WrittenDigits::are_doubles() const {
  constexpr std::int32_t kDigitsOfDoubles = 15;
  return most_digits_ >= kDigitsOfDoubles;
}

void WrittenNumbers::add(const WrittenNumber& number) {
  digits_.add(number);
  const bool may_be_short = !number.has_exponent && !std::signbit(number.value) &&
                            number.decimals <= kMostDecimals && number.digits <= 9;
  if (may_be_short) {
    const double mantissa =
        std::round(number.value * kPowers[static_cast<std::size_t>(number.decimals)]);
    // NaN and infinity fail this.
    if (mantissa <= kMostMantissa) {
      codes_.push_back(static_cast<std::uint32_t>(number.decimals) << kDigitBits |
                       static_cast<std::uint32_t>(mantissa));
      return;
    }
  }
  codes_.push_back(kIsIndex | static_cast<std::uint32_t>(wide_.size()));
  wide_.push_back({number.value, static_cast<std::int16_t>(number.decimals),
                   static_cast<std::int16_t>(number.digits), number.has_exponent});
}

WrittenNumber WrittenNumbers::operator[](std::size_t index) const {
  const std::uint32_t code = codes_[index];
  if ((code & kIsIndex) != 0) {
    const Wide& wide = wide_[code & ~kIsIndex];
    return {wide.value, wide.decimals, wide.digits, wide.has_exponent};
  }
  const std::uint32_t mantissa = code & kMostMantissa;
  const auto decimals = static_cast<std::int32_t>(code >> kDigitBits);
  return {mantissa / kPowers[static_cast<std::size_t>(decimals)], decimals, digit_count(mantissa),
          false};
}

double WrittenDigits::rounding_of(const WrittenNumber& number) const {
  std::int32_t decimals = number.decimals;
  if (decimals < most_decimals_ && number.digits < most_digits_) {
    const std::int32_t by_digits = decimals + most_digits_ - number.digits;
    decimals = std::min(most_decimals_, by_digits);
  }
  return 0.5 * std::pow(10.0, -decimals);
}

}  // namespace gnomon::comparison
