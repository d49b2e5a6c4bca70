// SPDX-License-Identifier: LGPL-3.0-or-later
// Storage, reading and exact values of Number; its texts are in number_text.cc.
#include "gnomon/scene/number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/base/ascii_case.h"

namespace gnomon {

namespace {

/// A mantissa of at most this many bits is stored in place.
constexpr std::size_t kSmallBits = 63;
/// A subnormal double that is no smaller power of two times a 52-bit integer has at least 715
/// significant decimal digits (5^1023 has 716) and at most 767; texts outside that range are never
/// exactly a subnormal.
constexpr std::size_t kFewestSubnormalDigits = 700;
constexpr std::size_t kMostSubnormalDigits = 767;

constexpr std::int64_t kExponentCap = 1'000'000'000;  // far beyond anything that has a value

mpz_class power_of(unsigned base, unsigned long exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, exponent);
  return result;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A text taken apart: the digits lie in `digits` (which may hold one point), from the first that
/// is not 0 to the last that is not 0; the value is +-digits * 10^exponent.
struct DecimalText {
  bool negative = false;
  std::string_view digits;
  std::size_t digit_count = 0;
  std::int64_t exponent = 0;               // of the last significant digit
  std::int64_t leading_exponent() const {  // of the first significant digit
    return exponent + static_cast<std::int64_t>(digit_count) - 1;
  }
};

/// False if the text is not a number.
bool take_apart(std::string_view text, DecimalText& result) {
  std::size_t at = 0;
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) result.negative = text[at++] == '-';
  const std::size_t first = at;
  std::size_t point = std::string_view::npos;
  std::size_t first_significant = std::string_view::npos, last_significant = 0;
  std::size_t digit_total = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '.') {
      if (point != std::string_view::npos) return false;
      point = at;
    } else if (is_digit(c)) {
      ++digit_total;
      if (c != '0') {
        if (first_significant == std::string_view::npos) first_significant = at;
        last_significant = at;
      }
    } else {
      break;
    }
  }
  if (digit_total == 0 || at == first) return false;
  const std::size_t mantissa_end = at;
  std::int64_t written = 0;
  if (at < text.size()) {
    if (text[at] != 'e' && text[at] != 'E') return false;
    ++at;
    bool negative = false;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) negative = text[at++] == '-';
    if (at == text.size()) return false;
    for (; at < text.size(); ++at) {
      if (!is_digit(text[at])) return false;
      if (written < kExponentCap) written = written * 10 + (text[at] - '0');
    }
    if (negative) written = -written;
  }
  if (first_significant == std::string_view::npos) return true;  // zero
  result.digits = text.substr(first_significant, last_significant - first_significant + 1);
  const bool point_inside =
      point != std::string_view::npos && point > first_significant && point < last_significant;
  result.digit_count = result.digits.size() - (point_inside ? 1 : 0);
  const std::size_t units = point == std::string_view::npos ? mantissa_end : point;
  // The digit before the point stands for 10^0.
  const std::int64_t last_place = last_significant < units
                                      ? static_cast<std::int64_t>(units - last_significant) - 1
                                      : -static_cast<std::int64_t>(last_significant - units);
  result.exponent = written + last_place;
  return true;
}

mpz_class digits_value(const DecimalText& text) {
  std::string digits;
  digits.reserve(text.digit_count + 1);
  if (text.negative) digits += '-';
  for (const char c : text.digits) {
    if (c != '.') digits += c;
  }
  return mpz_class(digits, 10);
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMostShown = 40;
  std::string result;
  for (const char c : text.substr(0, kMostShown)) {
    result += c >= 0x20 && c < 0x7f ? c : '?';
  }
  if (text.size() > kMostShown) result += "...";
  return result;
}

bool says_not_finite(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  const std::string lower = lower_case(text.substr(0, 8));
  return lower.starts_with("nan") || lower.starts_with("inf") || lower.starts_with("1.#");
}

/// The double nearest to a text without leading plus sign; the magnitude tells overflow from
/// underflow.
double nearest_to_text(std::string_view text, std::int64_t leading_exponent, bool is_zero) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (is_zero) return 0;
  if (error == std::errc::result_out_of_range) {
    // The standard leaves the value alone; the sign is the caller's affair.
    value = leading_exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
    return text[0] == '-' ? -value : value;
  }
  return value;
}

/// m * 2^exponent rounded once, ties to even, whatever the size.
double round_dyadic(const mpz_class& mantissa, std::int64_t exponent) {
  const auto bits = static_cast<std::int64_t>(mpz_sizeinbase(mantissa.get_mpz_t(), 2));
  if (exponent + bits > 1024) {
    const double infinity = std::numeric_limits<double>::infinity();
    return sgn(mantissa) < 0 ? -infinity : infinity;
  }
  if (exponent + bits < -1075) return 0;
  const std::int64_t last = std::max<std::int64_t>(exponent + bits - 53, -1074);
  if (last <= exponent) return std::ldexp(mantissa.get_d(), static_cast<int>(exponent));
  const auto shift = static_cast<mp_bitcnt_t>(last - exponent);
  const mpz_class magnitude = abs(mantissa);
  mpz_class quotient = magnitude >> shift;
  const bool half = mpz_tstbit(magnitude.get_mpz_t(), shift - 1) != 0;
  const bool below_half = mpz_scan1(magnitude.get_mpz_t(), 0) < shift - 1;
  if (half && (below_half || mpz_odd_p(quotient.get_mpz_t()))) ++quotient;
  const double value = std::ldexp(quotient.get_d(), static_cast<int>(last));
  return sgn(mantissa) < 0 ? -value : value;
}

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

double round_decimal(const mpz_class& mantissa, std::int32_t exponent) {
  std::string text = mantissa.get_str();
  const auto digits = static_cast<std::int64_t>(text.size()) - (text[0] == '-' ? 1 : 0);
  text += 'e';
  text += std::to_string(exponent);
  return nearest_to_text(text, exponent + digits - 1, false);
}

}  // namespace

void Number::release() noexcept { delete big_; }

void Number::set(mpz_class mantissa, std::int64_t exponent, std::uint8_t base) {
  base_ = base;
  if (sgn(mantissa) == 0) return;
  exponent_ = static_cast<std::int32_t>(exponent);
  if (mpz_sizeinbase(mantissa.get_mpz_t(), 2) <= kSmallBits) {
    small_ = mantissa.get_si();
  } else {
    big_ = new mpz_class(std::move(mantissa));
    is_big_ = true;
  }
}

Number Number::from_decimal(mpz_class mantissa, std::int32_t exponent) {
  Number result;
  std::int64_t shifted = exponent;
  if (sgn(mantissa) != 0) {
    while (mpz_divisible_ui_p(mantissa.get_mpz_t(), 10)) {
      mpz_divexact_ui(mantissa.get_mpz_t(), mantissa.get_mpz_t(), 10);
      ++shifted;
    }
  }
  result.set(std::move(mantissa), shifted, 10);
  return result;
}

Number Number::from_dyadic(mpz_class mantissa, std::int32_t exponent) {
  Number result;
  std::int64_t shifted = exponent;
  if (sgn(mantissa) != 0) {
    const mp_bitcnt_t zeros = mpz_scan1(mantissa.get_mpz_t(), 0);
    mantissa >>= zeros;
    shifted += static_cast<std::int64_t>(zeros);
  }
  result.set(std::move(mantissa), shifted, 2);
  return result;
}

Expected<Number> Number::parse(std::string_view text, NumberMeaning meaning, bool* underflow) {
  DecimalText parts;
  if (!take_apart(text, parts)) {
    if (says_not_finite(text)) {
      return fail(ErrorCode::kNumber, "'" + shown(text) + "' is not finite", "a finite number");
    }
    return fail(ErrorCode::kNumber, "'" + shown(text) + "' is not a number",
                "a number such as -12.5e-3");
  }
  const bool is_zero = parts.digit_count == 0;
  if (meaning == NumberMeaning::kDouble) {
    const std::string_view unsigned_plus = text[0] == '+' ? text.substr(1) : text;
    const double value = nearest_to_text(unsigned_plus, parts.leading_exponent(), is_zero);
    if (std::isinf(value)) {
      return fail(ErrorCode::kNumber, "'" + shown(text) + "' is too large for a double",
                  "a magnitude of at most 1.7976931348623157e308");
    }
    Number result(value);
    if (underflow != nullptr && !is_zero && std::abs(value) < std::numeric_limits<double>::min()) {
      const bool exact =
          value != 0 && parts.digit_count >= kFewestSubnormalDigits &&
          parts.digit_count <= kMostSubnormalDigits &&
          from_decimal(digits_value(parts), static_cast<std::int32_t>(parts.exponent)) == result;
      if (!exact) *underflow = true;
    }
    return result;
  }
  Number result;
  result.base_ = 10;
  if (is_zero) return result;
  if (parts.digit_count > kMaxDecimalDigits) {
    return fail(ErrorCode::kLimit,
                "'" + shown(text) + "' has " + std::to_string(parts.digit_count) + " digits",
                "at most " + std::to_string(kMaxDecimalDigits) + " digits in a decimal number");
  }
  if (std::abs(parts.leading_exponent()) > kMaxDecimalExponent) {
    return fail(ErrorCode::kLimit, "'" + shown(text) + "' has an exponent beyond +-4096",
                "a decimal number between 1e-4096 and 1e4097");
  }
  constexpr std::size_t kDigitsThatFit = 18;
  if (parts.digit_count <= kDigitsThatFit) {
    std::int64_t mantissa = 0;
    for (const char c : parts.digits) {
      if (c != '.') mantissa = mantissa * 10 + (c - '0');
    }
    result.small_ = parts.negative ? -mantissa : mantissa;
    result.exponent_ = static_cast<std::int32_t>(parts.exponent);
    return result;
  }
  result.set(digits_value(parts), parts.exponent, 10);
  return result;
}

mpz_class Number::mantissa() const { return is_big_ ? *big_ : mpz_class(long{small_}); }

int Number::sign() const {
  if (is_big_) return sgn(*big_);
  return small_ > 0 ? 1 : small_ < 0 ? -1 : 0;
}

double Number::rounded() const {
  if (is_zero()) return 0;
  if (base_ == 2) return round_dyadic(mantissa(), exponent_);
  // Both operands exact, hence one rounding.
  if (has_exact_mantissa() && exponent_ >= -22 && exponent_ <= 22) {
    const double value = static_cast<double>(small_);
    return exponent_ < 0 ? value / kPowersOfTen[-exponent_] : value * kPowersOfTen[exponent_];
  }
  return round_decimal(mantissa(), exponent_);
}

mpq_class Number::exact() const {
  mpq_class result;
  mpz_class& numerator = result.get_num();
  mpz_class& denominator = result.get_den();
  numerator = mantissa();
  if (sgn(numerator) == 0) return result;
  const auto magnitude = static_cast<unsigned long>(std::abs(std::int64_t{exponent_}));
  if (exponent_ >= 0) {
    if (base_ == 2) {
      numerator <<= magnitude;
    } else {
      numerator *= power_of(10, magnitude);
    }
    return result;
  }
  if (base_ == 2) {
    denominator <<= magnitude;  // the numerator is odd: lowest terms
    return result;
  }
  // The mantissa has no factor 10, so at most one of 2 and 5 cancels.
  denominator = power_of(10, magnitude);
  const mp_bitcnt_t twos = std::min<mp_bitcnt_t>(mpz_scan1(numerator.get_mpz_t(), 0), magnitude);
  if (twos > 0) {
    numerator >>= twos;
    denominator >>= twos;
    return result;
  }
  for (unsigned long fives = 0; fives < magnitude && mpz_divisible_ui_p(numerator.get_mpz_t(), 5);
       ++fives) {
    mpz_divexact_ui(numerator.get_mpz_t(), numerator.get_mpz_t(), 5);
    mpz_divexact_ui(denominator.get_mpz_t(), denominator.get_mpz_t(), 5);
  }
  return result;
}

bool Number::is_double() const {
  if (base_ == 2) {
    const mpz_class digits = mantissa();
    const auto bits = static_cast<std::int64_t>(mpz_sizeinbase(digits.get_mpz_t(), 2));
    return is_zero() || (bits <= 53 && exponent_ >= -1074 && exponent_ + bits <= 1024);
  }
  const double value = nearest();
  return std::isfinite(value) && (value != 0 || is_zero()) && Number(value) == *this;
}

bool operator==(const Number& a, const Number& b) {
  if (a.is_zero() || b.is_zero()) return a.is_zero() && b.is_zero();
  if (a.base_ == b.base_) {
    if (a.exponent_ != b.exponent_ || a.is_big_ != b.is_big_) return false;
    return a.is_big_ ? *a.big_ == *b.big_ : a.small_ == b.small_;
  }
  if (a.sign() != b.sign()) return false;
  // Numbers with different nearest doubles differ; most pairs are told apart here.
  if (a.nearest() != b.nearest()) return false;
  return a.exact() == b.exact();
}

}  // namespace gnomon
