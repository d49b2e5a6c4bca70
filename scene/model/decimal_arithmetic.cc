// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/model/decimal_arithmetic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace gnomon {

namespace {

constexpr auto kPowers = [] {
  std::array<std::int64_t, 19> powers{};
  std::int64_t power = 1;
  for (std::size_t i = 0; i < powers.size(); ++i, power *= i < powers.size() ? 10 : 1)
    powers[i] = power;
  return powers;
}();

mpz_class power_of_ten(std::int64_t exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), 10, static_cast<unsigned long>(exponent));
  return result;
}

/// mantissa * 10^places without GMP; false if it does not fit.
bool shifted(const Number& number, std::int32_t places, std::int64_t& result) {
  return number.has_small_mantissa() && places < static_cast<std::int32_t>(kPowers.size()) &&
         !__builtin_mul_overflow(number.small_mantissa(), kPowers[static_cast<std::size_t>(places)],
                                 &result);
}

Number sum(const Number& a, const Number& b, bool subtract) {
  const std::int32_t exponent = std::min(a.exponent(), b.exponent());
  std::int64_t first = 0, second = 0, total = 0;
  if (shifted(a, a.exponent() - exponent, first) && shifted(b, b.exponent() - exponent, second) &&
      !(subtract ? __builtin_sub_overflow(first, second, &total)
                 : __builtin_add_overflow(first, second, &total)) &&
      total != std::numeric_limits<std::int64_t>::min()) {
    return Number::from_short_decimal(total, exponent);
  }
  const mpz_class left = a.mantissa() * power_of_ten(a.exponent() - exponent);
  const mpz_class right = b.mantissa() * power_of_ten(b.exponent() - exponent);
  return Number::from_decimal(subtract ? mpz_class(left - right) : mpz_class(left + right),
                              exponent);
}

}  // namespace

Number decimal_sum(const Number& a, const Number& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  return sum(a, b, false);
}

Number decimal_difference(const Number& a, const Number& b) {
  if (b.is_zero()) return a;
  return sum(a, b, true);
}

Number decimal_product(const Number& a, const Number& b) {
  if (a.is_zero() || b.is_zero()) return {};
  const std::int32_t exponent = a.exponent() + b.exponent();
  std::int64_t product = 0;
  if (a.has_small_mantissa() && b.has_small_mantissa() &&
      !__builtin_mul_overflow(a.small_mantissa(), b.small_mantissa(), &product) &&
      product != std::numeric_limits<std::int64_t>::min()) {
    return Number::from_short_decimal(product, exponent);
  }
  return Number::from_decimal(a.mantissa() * b.mantissa(), exponent);
}

Number negated_decimal(const Number& a) { return decimal_difference({}, a); }

bool is_decimal_fraction(const mpq_class& value) {
  mpz_class rest = value.get_den();
  for (const unsigned long factor : {2ul, 5ul}) {
    const mpz_class divisor(factor);
    mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), divisor.get_mpz_t());
  }
  return rest == 1;
}

Number decimal_of(const mpq_class& value) {
  mpz_class rest = value.get_den();
  const mpz_class two(2), five(5);
  const auto twos =
      static_cast<std::int64_t>(mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), two.get_mpz_t()));
  const auto fives =
      static_cast<std::int64_t>(mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), five.get_mpz_t()));
  const std::int64_t places = std::max(twos, fives);
  const mpz_class mantissa = value.get_num() * power_of_ten(places) / value.get_den();
  return Number::from_decimal(mantissa, static_cast<std::int32_t>(-places));
}

Number rounded_decimal(const mpq_class& value, unsigned places) {
  const mpq_class scaled = abs(value) * power_of_ten(places);
  mpz_class mantissa = (2 * scaled.get_num() + scaled.get_den()) / (2 * scaled.get_den());
  if (sgn(value) < 0) mantissa = -mantissa;
  return Number::from_decimal(mantissa, -static_cast<std::int32_t>(places));
}

Expected<Number> as_meant(Number decimal, NumberMeaning meaning, bool& underflow) {
  if (decimal.is_zero()) {
    return meaning == NumberMeaning::kDecimal ? Number::from_short_decimal(0, 0) : Number();
  }
  const std::size_t digits = decimal.has_small_mantissa()
                                 ? std::to_string(std::abs(decimal.small_mantissa())).size()
                                 : mpz_class(abs(decimal.mantissa())).get_str().size();
  const std::int64_t leading = decimal.exponent() + static_cast<std::int64_t>(digits) - 1;
  if (digits > Number::kMaxDecimalDigits || std::abs(leading) > Number::kMaxDecimalExponent) {
    return fail(ErrorCode::kLimit, "a coordinate has too many digits, or too large an exponent",
                "at most 1000 digits and exponents up to 4096");
  }
  if (meaning == NumberMeaning::kDecimal) return decimal;
  const double nearest = decimal.nearest();
  if (!std::isfinite(nearest)) {
    return fail(ErrorCode::kNumber, "a coordinate is beyond the range of doubles",
                "a magnitude below 1.8e308");
  }
  if (std::abs(nearest) < std::numeric_limits<double>::min() && !(Number(nearest) == decimal)) {
    underflow = true;
  }
  return Number(nearest);
}

}  // namespace gnomon
