// SPDX-License-Identifier: LGPL-3.0-or-later
// What every kernel's light space has in common: the balanced prefix's planes, and what an
// algorithm gets back when it asks where a corner is.
//
// All shadow planes of one point or directional light pass through the light, so that SVBSP
// decisions are oriented projective geometry in two dimensions (see orientation.h for the map q).
#ifndef GNOMON_KERNEL_CONCEPT_LIGHT_SPACE_H
#define GNOMON_KERNEL_CONCEPT_LIGHT_SPACE_H

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

/// A chart of the directions with `sign` q_w > 0: (q_u / q_w, q_v / q_w). u, v, w are components of
/// q. A directional light has one chart, {0, 1, 2} and the sign of its d_z.
struct LightChart {
  int u = 0, v = 1, w = 2;
  int sign = 1;
  friend bool operator==(const LightChart&, const LightChart&) = default;
};

/// Where a point is as seen from the light. For a directional light u and v are x - z d_x / d_z and
/// y - z d_y / d_z of grid positions, in units of 2^b grid steps, so that they do not depend on the
/// kernel; for a point light they have no unit.
struct ChartPoint {
  double u = 0, v = 0;
  /// Grows towards the light, and is an affine function of (u, v) on every plane: 1 / |q_w| for a
  /// point light, sign * z for a directional one. The unit is the kernel's own.
  double z = 0;
  /// Bounds of the absolute errors of u and v, and of z; infinite where nothing is known. Rounded
  /// kernels take their coordinates as they are and count only what is rounded here.
  double uv_error = 0, z_error = 0;
};

/// A point of a support plane in an affine frame of that plane; `error` bounds that of x and of y.
struct PlanarPoint {
  double x = 0, y = 0;
  double error = 0;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_LIGHT_SPACE_H
