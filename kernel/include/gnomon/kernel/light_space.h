// SPDX-License-Identifier: LGPL-3.0-or-later
// What every kernel's light space has in common: the balanced prefix's planes, and what an algorithm
// gets back when it asks where a corner is.
//
// All shadow planes of one point or directional light pass through the light, so that SVBSP decisions
// are oriented projective geometry in two dimensions (see orientation.h for the map q).
#ifndef GNOMON_KERNEL_LIGHT_SPACE_H
#define GNOMON_KERNEL_LIGHT_SPACE_H

#include <gmpxx.h>

#include <array>
#include <cstdint>

#include "gnomon/kernel/geometry.h"

namespace gnomon {

/// A plane through the light with small integer coefficients in q coordinates: n . q. Rounding the
/// value at which the prefix splits is free, the plane itself is exact.
struct PrefixPlane {
  std::array<std::int64_t, 3> n{};  // |n_k| <= 2^kBits
  static constexpr unsigned kBits = 24;
};

/// The axis permutation of the map q: component k of the formulas is component axis(k) of the scene.
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

/// In which coordinate plane areas on a support plane are measured: drop the axis of the largest
/// normal component. Fractions of a polygon's area do not depend on it.
struct Chart {
  int u = 0, v = 1, dropped = 2;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_LIGHT_SPACE_H
