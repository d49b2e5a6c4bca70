// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/decimal_text.h"

#include <fmt/format.h>

#include <cmath>

namespace gnomon::report {

namespace {

mpz_class power_of_ten(long exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(exponent));
  return power;
}

/// log10, off by far less than 1.
double logarithm(const mpz_class& positive) {
  constexpr double kLogOfTwo = 0.30102999566398120;
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, positive.get_mpz_t());
  return std::log10(mantissa) + kLogOfTwo * static_cast<double>(exponent);
}

/// The integer nearest to value / 10^exponent, halves upwards.
mpz_class rounded_quotient(const mpq_class& value, long exponent) {
  mpz_class numerator = 2 * value.get_num(), denominator = 2 * value.get_den();
  (exponent < 0 ? numerator : denominator) *= power_of_ten(std::labs(exponent));
  numerator += denominator / 2;
  return numerator / denominator;
}

}  // namespace

std::string decimal_text(const mpq_class& value, int digits) {
  if (value == 0) return "0";
  const mpq_class size = abs(value);
  auto exponent =
      static_cast<long>(std::floor(logarithm(size.get_num()) - logarithm(size.get_den())));
  // The first guess may be off by one, and rounding may lead to one digit more.
  const mpz_class least = power_of_ten(digits - 1);
  if (rounded_quotient(size, exponent - (digits - 1)) < least) --exponent;
  if (rounded_quotient(size, exponent - (digits - 1)) >= 10 * least) ++exponent;
  std::string text = rounded_quotient(size, exponent - (digits - 1)).get_str();
  text.erase(text.find_last_not_of('0') + 1);
  if (text.size() > 1) text.insert(1, ".");
  return fmt::format("{}{}e{:+03}", sgn(value) < 0 ? "-" : "", text, exponent);
}

}  // namespace gnomon::report
