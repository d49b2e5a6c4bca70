// SPDX-License-Identifier: LGPL-3.0-or-later
// What every kernel's light space has in common: the balanced prefix's planes, and what an
// algorithm gets back when it asks where a corner is.
//
// All shadow planes of one point or directional light pass through the light, so that SVBSP
// decisions are oriented projective geometry in two dimensions (see orientation.h for the map q).
#ifndef GNOMON_KERNEL_LIGHT_SPACE_H
#define GNOMON_KERNEL_LIGHT_SPACE_H

#include <gmpxx.h>

#include <array>
#include <cstdint>

#include "gnomon/kernel/geometry.h"

namespace gnomon {

/// A plane through the light with integer coefficients in q coordinates (of grid positions): n . q.
/// Rounding the value at which the prefix splits is free, the plane itself is exact. For a
/// directional light one of n[0] and n[1] is zero.
struct PrefixPlane {
  std::array<mpz_class, 3> n;
};

/// The axis permutation of the map q: component k of the formulas is component axis(k) of the
/// scene.
struct LightAxes {
  int x = 0, y = 1, z = 2;
  /// For a directional light: z is the largest component of the direction, cyclically.
  static LightAxes of(const LightPoint& light) {
    if (!light.directional) return {};
    int largest = 0;
    for (int k = 1; k < 3; ++k) {
      if (cmpabs(light.grid[k], light.grid[largest]) > 0) largest = k;
    }
    return {(largest + 1) % 3, (largest + 2) % 3, largest};
  }

 private:
  static int cmpabs(const mpz_class& a, const mpz_class& b) {
    return mpz_cmpabs(a.get_mpz_t(), b.get_mpz_t());
  }
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_LIGHT_SPACE_H
