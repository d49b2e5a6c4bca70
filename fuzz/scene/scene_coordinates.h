// SPDX-License-Identifier: GPL-3.0-or-later
// The coordinates of a scene as integers on one grid, to be moved, rounded and written back: the
// arithmetic of shrinking, exact in both meanings of numbers.
#ifndef GNOMON_FUZZ_SCENE_SCENE_COORDINATES_H
#define GNOMON_FUZZ_SCENE_SCENE_COORDINATES_H

#include <gmpxx.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

inline constexpr std::size_t kAxes = 3;

/// Vertices, point lights and corners of area lights, in this order; directions are not positions.
std::vector<Position*> positions_of(Scene& scene);
/// to_light of directional lights.
std::vector<Position*> directions_of(Scene& scene);
/// Positions and directions.
std::vector<Position*> points_of(Scene& scene);
std::vector<const Position*> points_of(const Scene& scene);

/// Values times base^exponent.
struct GridValues {
  unsigned base = 2;  // 10 in a scene of decimals
  std::int32_t exponent = 0;
  std::vector<mpz_class> values;

  /// One value as a number of the scene. False if the scene cannot hold it (it is no double).
  bool number(const mpz_class& value, Number& result) const;
};

/// The coarsest grid that holds all of them.
GridValues on_grid(std::span<const Number* const> numbers, NumberMeaning meaning);

/// base^exponent. Requires: exponent >= 0.
mpz_class power_of(unsigned base, unsigned long exponent);
/// Binary digits of the magnitude; 0 has none.
std::size_t bits_of(const mpz_class& value);
/// The quotient rounded to the nearest integer, ties towards 0.
mpz_class rounded_quotient(const mpz_class& value, const mpz_class& divisor);

/// What a coordinate costs: bits of its mantissa, plus what its exponent is away from 0, plus 1 for
/// a sign and 1 for a fraction. 0 costs nothing, and small whole numbers are cheap.
std::uint64_t bits_of(const Number& number);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SCENE_SCENE_COORDINATES_H
