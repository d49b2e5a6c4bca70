// SPDX-License-Identifier: GPL-3.0-or-later
// Convex polygons in space, cut down by half-spaces, in rational numbers of scene units: the
// geometry of the checker of claims, which has no charts and no grid.
//
// Exactness: exact; the doubles of a half-space only put aside what is clearly apart.
#ifndef GNOMON_ORACLE_GEOMETRY_SPACE_LOOP_H
#define GNOMON_ORACLE_GEOMETRY_SPACE_LOOP_H

#include <gmpxx.h>

#include <array>
#include <span>
#include <vector>

#include "gnomon/result/claims.h"

namespace gnomon::oracle::space {

using Loop = std::vector<RationalPoint>;

RationalPoint minus(const RationalPoint& a, const RationalPoint& b);
mpq_class dot(const RationalPoint& a, const RationalPoint& b);
RationalPoint cross(const RationalPoint& a, const RationalPoint& b);
RationalPoint negated(const RationalPoint& a);

/// normal . (x - base) >= 0.
struct HalfSpace {
  RationalPoint normal, base;
  std::array<double, 3> near_normal{}, near_base{};  // normal of length about 1

  HalfSpace(RationalPoint n, const RationalPoint& b);
  mpq_class value(const RationalPoint& point) const { return dot(normal, minus(point, base)); }
  double near_value(const std::array<double, 3>& p) const;
};

/// What is left of a convex loop in a half-space; empty without area there.
Loop cut(const Loop& loop, const HalfSpace& half);

/// What is left of convex loops without an intersection of half-spaces, as convex loops that do not
/// overlap if the given ones do not. No half-spaces: nothing is left.
std::vector<Loop> without(std::vector<Loop> loops, std::span<const HalfSpace> bounds);

/// A plane seen along an axis that it does not contain: turns and areas of what lies in it take two
/// coordinates of three.
class PlaneView {
 public:
  /// Requires: a normal that is not zero.
  explicit PlaneView(const RationalPoint& normal);

  /// 1 if the way from a over b to c turns left, seen from where the normal points; -1 right; 0 if
  /// they are on one line. Requires: points in one plane with the normal.
  int turn(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) const;
  /// area_along() the normal. Requires: a loop in one plane with it.
  mpq_class area(const Loop& loop) const;

 private:
  int x_ = 0, y_ = 1;  // coordinates in which left is left
  mpq_class scale_;    // from twice the area seen to that along the normal
};

/// Area along a normal: half of normal . area vector. Signed by the loop's orientation.
mpq_class area_along(const RationalPoint& normal, const Loop& loop);
mpq_class area_along(const RationalPoint& normal, const std::vector<Loop>& loops);

}  // namespace gnomon::oracle::space

#endif  // GNOMON_ORACLE_GEOMETRY_SPACE_LOOP_H
