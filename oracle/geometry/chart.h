// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle's own exact geometry, on the integers of the scene's grid: support planes, and charts
// that draw a plane in two dimensions by dropping the axis of its largest normal component.
//
// Exactness: everything is exact. Points of a chart are homogeneous and canonical (w > 0, no common
// factor), so that equal points are equal as data. Dropping an axis is an affine map of the plane:
// ratios of areas are kept, and the area in the plane is the chart's times |n| / |n_axis|.
// Orientation may be mirrored; every loop is therefore oriented in the chart, never by its order in
// space.
#ifndef GNOMON_ORACLE_GEOMETRY_CHART_H
#define GNOMON_ORACLE_GEOMETRY_CHART_H

#include <gmpxx.h>

#include <array>
#include <span>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/result/claims.h"

namespace gnomon::oracle {

using Integers3 = std::array<mpz_class, 3>;

/// n . x - d on the grid: positive in front.
struct ExactPlane {
  Integers3 normal;
  mpz_class offset;
};

/// A point in space, on the grid's axes: (x, y, z) / w, w > 0.
struct HomogeneousPoint {
  Integers3 xyz;
  mpz_class w = 1;
};

/// A point of a chart, (x / w, y / w); canonical: w > 0 and gcd(x, y, w) = 1.
struct ChartPoint {
  mpz_class x, y, w = 1;
  friend bool operator==(const ChartPoint& a, const ChartPoint& b) {
    return a.x == b.x && a.y == b.y && a.w == b.w;
  }
};

/// a x + b y + c: positive inside.
struct ChartLine {
  mpz_class a, b, c;
};

Integers3 minus(const Integers3& a, const Integers3& b);
Integers3 cross(const Integers3& a, const Integers3& b);
mpz_class dot(const Integers3& a, const Integers3& b);
mpz_class value_at(const ExactPlane& plane, const Integers3& point);
/// Value times w; the sign is that of the value, since w > 0.
mpz_class value_at(const ExactPlane& plane, const HomogeneousPoint& point);
ExactPlane opposite(ExactPlane plane);
/// Divides by the common factor of all coefficients; the plane stays the same.
void reduce(ExactPlane& plane);

/// Plane of a planar loop by its area vector, counter-clockwise seen from the front. Exact for
/// planar loops; the normal is zero if the loop has no area. The area vector is twice the area, in
/// grid units.
Integers3 area_vector(std::span<const Integers3> loop);
ExactPlane plane_of(std::span<const Integers3> loop);

/// Position of a scene point on the grid's axes.
HomogeneousPoint to_grid(const Geometry& geometry, const RationalPoint& point);

int sign_at(const ChartLine& line, const ChartPoint& point);
/// Positive to the left of a -> b; zero line if a = b.
ChartLine line_through(const ChartPoint& a, const ChartPoint& b);
void reduce(ChartLine& line);
void reduce(ChartPoint& point);
/// Requires: not parallel.
ChartPoint meet(const ChartLine& a, const ChartLine& b);
int compare_x(const ChartPoint& a, const ChartPoint& b);
int compare_y(const ChartPoint& a, const ChartPoint& b);
/// Lexicographic: x, then y.
int compare(const ChartPoint& a, const ChartPoint& b);
int orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c);

class Chart {
 public:
  explicit Chart(const ExactPlane& support);

  const ExactPlane& support() const { return support_; }
  int axis() const { return axis_; }
  ChartPoint at(const Integers3& point) const;
  /// Orthogonal projection on the support plane, then the chart: a rational map.
  ChartPoint project(const HomogeneousPoint& point) const;
  /// Where a plane meets the support plane, with the same signs there. (0, 0, c) if parallel.
  ChartLine trace(const ExactPlane& plane) const;
  /// The point of the support plane, on the grid's axes.
  HomogeneousPoint lift(const ChartPoint& point) const;
  /// The same in scene units.
  RationalPoint lift_to_scene(const Geometry& geometry, const ChartPoint& point) const;

 private:
  ExactPlane support_;
  int axis_ = 2, first_ = 0, second_ = 1;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_CHART_H
