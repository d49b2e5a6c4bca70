// SPDX-License-Identifier: LGPL-3.0-or-later
// The texts of Number: as many digits as are needed to read the same value back, and no more.
#include <charconv>

#include "gnomon/scene/number.h"

namespace gnomon {

namespace {

/// Writes +-digits * 10^exponent, digits without zeros at the ends; without an exponent where that
/// adds few zeros (the rule of ECMAScript, and for long integers also their own length).
std::string layout(bool negative, std::string_view digits, std::int64_t exponent) {
  constexpr std::int64_t kMostPlaces = 21;
  constexpr std::int64_t kMostLeadingZeros = 6;
  const auto count = static_cast<std::int64_t>(digits.size());
  const std::int64_t places = count + exponent;  // digits before the point
  std::string text = negative ? "-" : "";
  if (exponent >= 0 && (places <= kMostPlaces || exponent == 0)) {
    text += digits;
    text.append(static_cast<std::size_t>(exponent), '0');
  } else if (exponent < 0 && places > 0) {
    text += digits.substr(0, static_cast<std::size_t>(places));
    text += '.';
    text += digits.substr(static_cast<std::size_t>(places));
  } else if (exponent < 0 && places > -kMostLeadingZeros) {
    text += "0.";
    text.append(static_cast<std::size_t>(-places), '0');
    text += digits;
  } else {
    text += digits[0];
    if (count > 1) {
      text += '.';
      text += digits.substr(1);
    }
    text += 'e';
    text += std::to_string(places - 1);
  }
  return text;
}

std::string shortest_text(double value) {
  if (value == 0) return "0";
  char buffer[64];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific);
  (void)error;  // 64 bytes hold every double
  std::string digits;
  const char* at = buffer;
  const bool negative = *at == '-';
  if (negative) ++at;
  for (; *at != 'e'; ++at) {
    if (*at != '.') digits += *at;
  }
  ++at;
  if (*at == '+') ++at;
  int leading = 0;
  std::from_chars(at, end, leading);
  while (digits.size() > 1 && digits.back() == '0') digits.pop_back();
  return layout(negative, digits, leading - static_cast<std::int64_t>(digits.size()) + 1);
}

std::string decimal_text(const mpz_class& mantissa, std::int64_t exponent) {
  if (sgn(mantissa) == 0) return "0";
  std::string digits = mantissa.get_str();
  const bool negative = digits[0] == '-';
  if (negative) digits.erase(0, 1);
  while (digits.back() == '0') {
    digits.pop_back();
    ++exponent;
  }
  return layout(negative, digits, exponent);
}

/// mantissa * 2^exponent as a decimal: every dyadic number is one.
std::string expansion_text(mpz_class mantissa, std::int32_t exponent) {
  if (exponent >= 0) {
    mantissa <<= static_cast<mp_bitcnt_t>(exponent);
    return decimal_text(mantissa, 0);
  }
  mpz_class fives;
  mpz_ui_pow_ui(fives.get_mpz_t(), 5, static_cast<unsigned long>(-std::int64_t{exponent}));
  return decimal_text(mantissa * fives, exponent);
}

}  // namespace

std::string Number::to_text() const {
  if (is_decimal()) return decimal_text(mantissa(), exponent_);
  return is_double() ? shortest_text(nearest()) : expansion_text(mantissa(), exponent_);
}

Expected<std::string> Number::to_text(NumberMeaning meaning) const {
  if (meaning == NumberMeaning::kDouble) {
    if (is_double()) return shortest_text(nearest());
    return fail(ErrorCode::kNumber, to_text() + " is not exactly a double",
                "numbers written as decimals");
  }
  std::string text =
      is_decimal() ? decimal_text(mantissa(), exponent_) : expansion_text(mantissa(), exponent_);
  // What reads back is what may be written.
  if (auto read_back = parse(text, meaning); !read_back) return tl::unexpected(read_back.error());
  return text;
}

}  // namespace gnomon
