// SPDX-License-Identifier: GPL-3.0-or-later
// Fractions as text: "3/4", "1".
#ifndef GNOMON_FUZZ_TEXT_RATIONAL_TEXT_H
#define GNOMON_FUZZ_TEXT_RATIONAL_TEXT_H

#include <gmpxx.h>

#include <optional>
#include <string>
#include <string_view>

namespace gnomon::fuzz {

/// digits[/digits], the denominator not 0; reduced to lowest terms.
inline std::optional<mpq_class> parse_fraction(std::string_view text) {
  const auto is_digits = [](std::string_view digits) {
    return !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
  };
  const std::size_t slash = text.find('/');
  const std::string over(text.substr(0, slash));
  const std::string under(slash == std::string_view::npos ? "1" : text.substr(slash + 1));
  if (!is_digits(over) || !is_digits(under)) return std::nullopt;
  const mpz_class denominator(under, 10);
  if (denominator == 0) return std::nullopt;
  mpq_class value(mpz_class(over, 10), denominator);
  value.canonicalize();
  return value;
}

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_TEXT_RATIONAL_TEXT_H
