// SPDX-License-Identifier: LGPL-3.0-or-later
// What the spaces of the kernel `epick` ask of CGAL: sides, exact for the rounded points, and
// crossings, rounded.
#ifndef GNOMON_KERNEL_CGAL_EPICK_PREDICATES_H
#define GNOMON_KERNEL_CGAL_EPICK_PREDICATES_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

#include "kernel/cgal/epick_space.h"

namespace gnomon::epick_detail {

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = std::array<double, 3>;

inline bool is_finite(const Point& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}
inline Epick::Point_3 cgal(const Point& p) { return {p[0], p[1], p[2]}; }

inline Sign orientation(const Point& a, const Point& b, const Point& c, const Point& v) {
  // CGAL's predicates are defined for finite points only; a construction that overflowed says
  // nothing.
  if (!is_finite(v) || !is_finite(b) || !is_finite(c)) return Sign::kZero;
  return static_cast<Sign>(static_cast<int>(CGAL::orientation(cgal(a), cgal(b), cgal(c), cgal(v))));
}

template <class Number>
Number determinant(const std::array<Number, 3>& a, const std::array<Number, 3>& b,
                   const std::array<Number, 3>& c) {
  return Number(a[0] * Number(b[1] * c[2] - b[2] * c[1]) -
                a[1] * Number(b[0] * c[2] - b[2] * c[0]) +
                a[2] * Number(b[0] * c[1] - b[1] * c[0]));
}

/// Exact sign of (d x (c - a)) . (v - a): CGAL has no such predicate on points (a + d is rounded),
/// so the same recipe by hand: an enclosure, then rationals.
inline Sign direction_orientation(const Point& a, const Point& d, const Point& c, const Point& v) {
  if (!is_finite(v) || !is_finite(a) || !is_finite(c)) return Sign::kZero;
  std::array<Ball, 3> bd, bc, bv;
  for (int k = 0; k < 3; ++k) {
    bd[k] = Ball(d[k]);
    bc[k] = Ball(c[k]) - Ball(a[k]);
    bv[k] = Ball(v[k]) - Ball(a[k]);
  }
  const Ball value = determinant(bd, bc, bv);
  if (value.is_finite()) {
    if (value.lower() > 0) return Sign::kPositive;
    if (value.upper() < 0) return Sign::kNegative;
  }
  std::array<mpq_class, 3> qd, qc, qv;
  for (int k = 0; k < 3; ++k) {
    qd[k] = d[k];
    qc[k] = mpq_class(c[k]) - mpq_class(a[k]);
    qv[k] = mpq_class(v[k]) - mpq_class(a[k]);
  }
  return static_cast<Sign>(sgn(determinant(qd, qc, qv)));
}

/// Requires: not kLinear.
inline Side side_of_points(const EpickPlane& plane, const Point& v) {
  return side_of(plane.kind == EpickPlane::Kind::kPoints
                     ? orientation(plane.a, plane.b, plane.c, v)
                     : direction_orientation(plane.a, plane.b, plane.c, v));
}

/// The doubles themselves; zero for a point that is not finite.
inline std::array<mpq_class, 3> exact_point(const Point& x) {
  std::array<mpq_class, 3> point;
  if (!is_finite(x)) return point;
  for (int k = 0; k < 3; ++k) point[k] = x[k];
  return point;
}

/// Coefficients in doubles, for constructions.
inline Epick::Plane_3 coefficients(const EpickPlane& plane) {
  const Epick::Point_3 a = cgal(plane.a), c = cgal(plane.c);
  if (plane.kind == EpickPlane::Kind::kDirection) {
    const Epick::Vector_3 d(plane.b[0], plane.b[1], plane.b[2]);
    return {a, CGAL::cross_product(d, c - a)};
  }
  return {a, cgal(plane.b), c};
}

/// CGAL's own construction. The predicates put the two ends strictly on different sides, exactly;
/// the construction knows nothing of that, and where an edge lies almost in the plane it may put
/// the point far outside the edge. That is what the kernel does, so that is what is measured.
inline EpickVertex meeting_point(const Epick::Plane_3& plane, const Point& from, const Point& to) {
  EpickVertex vertex;
  const auto result = CGAL::intersection(plane, Epick::Line_3(cgal(from), cgal(to)));
  const Epick::Point_3* point = result ? boost::get<Epick::Point_3>(&*result) : nullptr;
  for (int k = 0; k < 3; ++k) {
    // No point: parallel, or in the plane, after rounding. Either end is as good.
    vertex.x[static_cast<std::size_t>(k)] =
        point != nullptr ? (*point)[k] : from[static_cast<std::size_t>(k)];
  }
  return vertex;
}

}  // namespace gnomon::epick_detail

#endif  // GNOMON_KERNEL_CGAL_EPICK_PREDICATES_H
