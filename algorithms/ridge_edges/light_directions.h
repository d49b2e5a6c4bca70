// SPDX-License-Identifier: LGPL-3.0-or-later
// Points of a scene as directions seen from a light, with the sign of three of them, exactly. One
// form for lamps and suns: of a lamp a direction is the vector from the point to the lamp, of a sun
// (u, v, w) in a chart across its rays, with one w for all that is about as large as u and v, so
// that directions of length 1 are as far apart as the points. A loop is counter-clockwise as the
// light sees it where det(a, b, c) > 0.
#ifndef GNOMON_ALGORITHMS_RIDGE_EDGES_LIGHT_DIRECTIONS_H
#define GNOMON_ALGORITHMS_RIDGE_EDGES_LIGHT_DIRECTIONS_H

#include <gmpxx.h>

#include <array>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/sign.h"

namespace gnomon {

using DirectionVector = std::array<mpz_class, 3>;

/// A vector with a nearest one of length about 1, which decides most signs.
struct FilteredVector {
  DirectionVector exact;
  std::array<double, 3> nearest{};  // each within 4u of exact / |exact|, u = 2^-53

  FilteredVector() = default;
  explicit FilteredVector(DirectionVector vector);
};

/// The sign of a . b.
Sign side(const FilteredVector& a, const FilteredVector& b);
/// Divided by the greatest common divisor of its coordinates. Requires: not zero.
DirectionVector primitive(DirectionVector vector);

/// The directions of all vertices of a scene to one light.
struct LightDirections {
  LightDirections(const Geometry& geometry, const LightPoint& light);

  /// (u, v, 1) in the sun's chart, a multiple of it; of a lamp the direction itself.
  DirectionVector exported(const DirectionVector& direction) const;

  std::vector<FilteredVector> of;  // by vertices
  mpz_class unit = 1;              // w of a sun
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RIDGE_EDGES_LIGHT_DIRECTIONS_H
