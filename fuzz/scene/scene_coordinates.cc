// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/scene/scene_coordinates.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::fuzz {

namespace {

/// `Place` is Position* or const Position*.
template <class Place, class AnyScene>
void add_positions(AnyScene& scene, std::vector<Place>& result) {
  for (auto& vertex : scene.vertices) result.push_back(&vertex);
  for (auto& light : scene.lights) {
    if (light.is_point()) result.push_back(&light.position);
    for (auto& corner : light.loop) result.push_back(&corner);
  }
}

template <class Place, class AnyScene>
void add_directions(AnyScene& scene, std::vector<Place>& result) {
  for (auto& light : scene.lights) {
    if (light.is_directional()) result.push_back(&light.position);
  }
}

}  // namespace

std::vector<Position*> positions_of(Scene& scene) {
  std::vector<Position*> result;
  add_positions(scene, result);
  return result;
}

std::vector<Position*> directions_of(Scene& scene) {
  std::vector<Position*> result;
  add_directions(scene, result);
  return result;
}

std::vector<Position*> points_of(Scene& scene) {
  std::vector<Position*> result;
  add_positions(scene, result);
  add_directions(scene, result);
  return result;
}

std::vector<const Position*> points_of(const Scene& scene) {
  std::vector<const Position*> result;
  add_positions(scene, result);
  add_directions(scene, result);
  return result;
}

mpz_class power_of(unsigned base, unsigned long exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, exponent);
  return result;
}

std::size_t bits_of(const mpz_class& value) {
  return sgn(value) == 0 ? 0 : mpz_sizeinbase(value.get_mpz_t(), 2);
}

mpz_class rounded_quotient(const mpz_class& value, const mpz_class& divisor) {
  const mpz_class magnitude = abs(value) * 2 + divisor - 1;
  mpz_class result = magnitude / (divisor * 2);
  return sgn(value) < 0 ? mpz_class(-result) : result;
}

std::uint64_t bits_of(const Number& number) {
  if (number.is_zero()) return 0;
  constexpr std::uint64_t kBitsOfTen = 4;
  const std::int64_t exponent = number.exponent();
  const std::uint64_t step = number.is_decimal() ? kBitsOfTen : 1;
  return bits_of(number.mantissa()) + step * static_cast<std::uint64_t>(std::abs(exponent)) +
         (exponent < 0 ? 1 : 0) + (number.sign() < 0 ? 1 : 0);
}

GridValues on_grid(std::span<const Number* const> numbers, NumberMeaning meaning) {
  GridValues grid;
  grid.base = meaning == NumberMeaning::kDecimal ? 10 : 2;
  // A fraction of a power of two is a decimal of as many digits; a power of two is whole.
  const auto exponent_in_base = [&](const Number& number) {
    if (grid.base == 10 && !number.is_decimal()) return std::min(number.exponent(), 0);
    return number.exponent();
  };
  std::optional<std::int32_t> least;
  for (const Number* number : numbers) {
    if (number->is_zero()) continue;
    const std::int32_t own = exponent_in_base(*number);
    least = least ? std::min(*least, own) : own;
  }
  grid.exponent = least.value_or(0);
  for (const Number* number : numbers) {
    mpz_class value = number->mantissa();
    if (!number->is_zero()) {
      const std::int32_t own = exponent_in_base(*number);
      if (grid.base == 10 && !number->is_decimal()) {
        const std::int32_t exponent = number->exponent();
        value *= exponent < 0 ? power_of(5, static_cast<unsigned long>(-exponent))
                              : power_of(2, static_cast<unsigned long>(exponent));
      }
      value *= power_of(grid.base, static_cast<unsigned long>(own - grid.exponent));
    }
    grid.values.push_back(std::move(value));
  }
  return grid;
}

bool GridValues::number(const mpz_class& value, Number& result) const {
  if (base == 10) {
    result = Number::from_decimal(value, exponent);
    return true;
  }
  result = Number::from_dyadic(value, exponent);
  return result.is_double();
}

}  // namespace gnomon::fuzz
