// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene's exact grid: the smallest box that holds all positions is moved with its lower corner
// to 0, and the greatest common step of all coordinates becomes 1. Part of preparation (prepare.h).
//
// Exactness: point i is exactly origin + step * (its grid coordinates); nothing is rounded,
// whatever the magnitudes. Coordinates are 64-bit integers if they all have at most
// GridPositions::kNarrowBits bits, GMP integers otherwise (doubles of 1e308 and 1e-308 in one
// scene: about 2100 bits).
#ifndef GNOMON_SCENE_GRID_H
#define GNOMON_SCENE_GRID_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon {

/// Points on their common grid, x0 y0 z0 x1 ..., all coordinates in [0, 2^bits - 1].
struct ExactGrid {
  bool is_narrow = true;
  std::vector<std::int64_t> narrow;  // if is_narrow
  std::vector<mpz_class> wide;       // otherwise
  mpq_class step = 1;               // scene units per grid unit, positive; 1 if all points coincide
  std::array<mpq_class, 3> origin;  // scene position of the grid's (0, 0, 0)
  unsigned bits = 0;                // of the largest coordinate

  mpz_class at(std::size_t point, int axis) const {
    const std::size_t i = 3 * point + static_cast<std::size_t>(axis);
    return is_narrow ? mpz_class(static_cast<long>(narrow[i])) : wide[i];
  }
};

/// Cost: O(n), in machine integers as long as all coordinates over their common unit have at most
/// 58 bits (64-bit integers) or 122 bits (128), in GMP integers otherwise.
ExactGrid make_grid(std::span<const Position* const> points);

/// A direction as the primitive integer vector (without common factor) on the same ray; all zero if
/// the vector is zero.
std::array<mpz_class, 3> primitive_direction(const Position& vector);

}  // namespace gnomon

#endif  // GNOMON_SCENE_GRID_H
