// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/model/decimal_vector.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "scene/model/decimal_arithmetic.h"

namespace gnomon::decimals {

namespace {

constexpr unsigned kAngleDigits = 12;
constexpr long kSignificantDigits = 16;

mpz_class power_of_ten(long exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), 10, static_cast<unsigned long>(exponent));
  return result;
}

/// The square root of a square of a rational number; nothing of any other number.
std::optional<mpq_class> rational_root(const mpq_class& value) {
  if (mpz_perfect_square_p(value.get_num_mpz_t()) == 0 ||
      mpz_perfect_square_p(value.get_den_mpz_t()) == 0) {
    return std::nullopt;
  }
  return mpq_class(sqrt(value.get_num()), sqrt(value.get_den()));
}

/// The square root of a positive number to kSignificantDigits digits, rounded down.
Number rounded_root(const mpq_class& value) {
  // The root of a number of 2k digits has k digits.
  const long digits = static_cast<long>(mpz_sizeinbase(value.get_num_mpz_t(), 10)) -
                      static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 10));
  const long places = kSignificantDigits - digits / 2;
  mpz_class scaled_square = value.get_num();
  if (places >= 0) {
    scaled_square = scaled_square * power_of_ten(2 * places) / value.get_den();
  } else {
    scaled_square = scaled_square / (value.get_den() * power_of_ten(-2 * places));
  }
  return Number::from_decimal(sqrt(scaled_square), static_cast<std::int32_t>(-places));
}

}  // namespace

Position sum(const Position& a, const Position& b) {
  return {decimal_sum(a[0], b[0]), decimal_sum(a[1], b[1]), decimal_sum(a[2], b[2])};
}

Position difference(const Position& a, const Position& b) {
  return {decimal_difference(a[0], b[0]), decimal_difference(a[1], b[1]),
          decimal_difference(a[2], b[2])};
}

Position scaled(const Position& a, const Number& factor) {
  return {decimal_product(a[0], factor), decimal_product(a[1], factor),
          decimal_product(a[2], factor)};
}

Number dot(const Position& a, const Position& b) {
  return decimal_sum(decimal_sum(decimal_product(a[0], b[0]), decimal_product(a[1], b[1])),
                     decimal_product(a[2], b[2]));
}

Position cross(const Position& a, const Position& b) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    return decimal_difference(decimal_product(a[i], b[j]), decimal_product(a[j], b[i]));
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

bool is_zero(const Position& a) { return a[0].is_zero() && a[1].is_zero() && a[2].is_zero(); }

Position area_vector(const std::vector<Position>& loop) {
  Position total;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    total = sum(total, cross(difference(loop[i], loop[0]), difference(loop[i + 1], loop[0])));
  }
  return total;
}

Length length_of(const Position& a) {
  const Number square = dot(a, a);
  if (square.is_zero()) return {};
  const auto root = rational_root(square.exact());
  if (root && is_decimal_fraction(*root)) return {decimal_of(*root), false};
  return {rounded_root(square.exact()), true};
}

UnitVector unit_vector(const Position& a) {
  const mpq_class square = dot(a, a).exact();
  const auto root = rational_root(square);
  if (root) {
    UnitVector result;
    bool fits = true;
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
      const mpq_class coordinate = a[axis].exact() / *root;
      fits = fits && is_decimal_fraction(coordinate);
      if (fits) result.vector[axis] = decimal_of(coordinate);
    }
    if (fits) return result;
  }
  return {scaled(a, rounded_root(1 / square)), true};
}

Angle angle_of(const Number& degrees) {
  mpq_class turns = degrees.exact() / 360;
  mpz_class whole;
  mpz_fdiv_q(whole.get_mpz_t(), turns.get_num_mpz_t(), turns.get_den_mpz_t());
  const mpq_class rest = (turns - whole) * 360;
  for (int quarter = 0; quarter < 4; ++quarter) {
    if (rest != 90 * quarter) continue;
    constexpr int kCosines[] = {1, 0, -1, 0}, kSines[] = {0, 1, 0, -1};
    return {Number::from_short_decimal(kCosines[quarter], 0),
            Number::from_short_decimal(kSines[quarter], 0), false, 0, 0};
  }
  const long double radians =
      static_cast<long double>(rest.get_d()) * std::numbers::pi_v<long double> / 180;
  const long double cosine = std::cos(radians), sine = std::sin(radians);
  constexpr long double kUnit = 1e12L;
  Angle angle;
  angle.is_rounded = true;
  angle.cosine = Number::from_short_decimal(std::llround(cosine * kUnit),
                                            -static_cast<std::int32_t>(kAngleDigits));
  angle.sine = Number::from_short_decimal(std::llround(sine * kUnit),
                                          -static_cast<std::int32_t>(kAngleDigits));
  const long double c = std::round(cosine * kUnit) / kUnit, s = std::round(sine * kUnit) / kUnit;
  angle.error =
      std::abs(static_cast<double>(std::atan2(s * cosine - c * sine, c * cosine + s * sine) * 180 /
                                   std::numbers::pi_v<long double>));
  const mpq_class c_exact = angle.cosine.exact(), s_exact = angle.sine.exact();
  angle.stretch = mpq_class(c_exact * c_exact + s_exact * s_exact - 1).get_d() / 2;
  return angle;
}

}  // namespace gnomon::decimals
