// SPDX-License-Identifier: LGPL-3.0-or-later
// Points of a scene as directions seen from a light, with the sign of three of them, exactly. One
// form for lamps and suns: of a lamp a direction is the vector from the point to the lamp, of a sun
// (u, v, 1) in a chart across its rays. A loop is counter-clockwise as the light sees it where
// det(a, b, c) > 0.
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
std::vector<FilteredVector> directions_to(const Geometry& geometry, const LightPoint& light);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RIDGE_EDGES_LIGHT_DIRECTIONS_H
