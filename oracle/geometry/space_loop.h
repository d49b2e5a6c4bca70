// SPDX-License-Identifier: GPL-3.0-or-later
// Convex polygons in space, cut down by half-spaces, in rational numbers of scene units: the
// geometry of the checker of claims, which has no charts and no grid.
//
// Exactness: exact; the doubles of a half-space only put aside what is clearly apart.
#ifndef GNOMON_ORACLE_GEOMETRY_SPACE_LOOP_H
#define GNOMON_ORACLE_GEOMETRY_SPACE_LOOP_H

#include <gmpxx.h>

#include <array>
#include <vector>

#include "gnomon/oracle/candidate.h"

namespace gnomon::oracle::space {

using Loop = std::vector<ExactPoint>;

ExactPoint minus(const ExactPoint& a, const ExactPoint& b);
mpq_class dot(const ExactPoint& a, const ExactPoint& b);
ExactPoint cross(const ExactPoint& a, const ExactPoint& b);
ExactPoint negated(const ExactPoint& a);

/// normal . (x - base) >= 0.
struct HalfSpace {
  ExactPoint normal, base;
  std::array<double, 3> near_normal{}, near_base{};  // normal of length about 1

  HalfSpace(ExactPoint n, const ExactPoint& b);
  mpq_class value(const ExactPoint& point) const { return dot(normal, minus(point, base)); }
  double near_value(const std::array<double, 3>& p) const;
};

/// What is left of a convex loop in a half-space; empty without area there.
Loop cut(const Loop& loop, const HalfSpace& half);

/// Area along a normal: half of normal . area vector. Signed by the loop's orientation.
mpq_class area_along(const ExactPoint& normal, const Loop& loop);

}  // namespace gnomon::oracle::space

#endif  // GNOMON_ORACLE_GEOMETRY_SPACE_LOOP_H
