// SPDX-License-Identifier: LGPL-3.0-or-later
// Three points of a plane of the grid, for kernels that make planes of points.
#ifndef GNOMON_KERNEL_CONCEPT_GRID_PLANE_POINTS_H
#define GNOMON_KERNEL_CONCEPT_GRID_PLANE_POINTS_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "kernel/concept/image_space.h"

namespace gnomon {

namespace grid_plane_detail {

/// Which component of the normal is largest, and the two after it.
struct Axes {
  std::size_t largest = 0, first = 1, second = 2;
};
inline Axes axes_of(const GridPlane& plane) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(plane.n[i]) > abs(plane.n[k])) k = i;
  }
  return {k, (k + 1) % 3, (k + 2) % 3};
}

/// a / b, within 6u of itself where it is no subnormal. Requires: b is not zero.
inline double near_quotient(const mpz_class& a, const mpz_class& b) {
  long of_a = 0, of_b = 0;
  const double first = mpz_get_d_2exp(&of_a, a.get_mpz_t());
  const double second = mpz_get_d_2exp(&of_b, b.get_mpz_t());
  return std::ldexp(first / second, static_cast<int>(std::clamp(of_a - of_b, -2000L, 2000L)));
}

}  // namespace grid_plane_detail

/// Points a, b, c with (b - a) x (c - a) along the plane's normal. Two of their coordinates are
/// corners of the square of 2^bits, a grid's size, and the third is across the normal's largest
/// component: for planes that cut a scene of this grid the points are as far apart as the scene is
/// large, so that rounding them turns the plane little. Exact.
inline std::array<std::array<mpq_class, 3>, 3> points_of(const GridPlane& plane, unsigned bits) {
  const grid_plane_detail::Axes axes = grid_plane_detail::axes_of(plane);
  const mpz_class size = mpz_class(1) << bits;
  const auto point = [&](const mpz_class& first, const mpz_class& second) {
    std::array<mpq_class, 3> x;
    x[axes.first] = first;
    x[axes.second] = second;
    x[axes.largest] =
        mpq_class(plane.d - plane.n[axes.first] * first - plane.n[axes.second] * second,
                  plane.n[axes.largest]);
    x[axes.largest].canonicalize();
    return x;
  };
  std::array<mpq_class, 3> a = point(0, 0), b = point(size, 0), c = point(0, size);
  // Their normal is n over its largest component.
  if (plane.n[axes.largest] < 0) std::swap(b, c);
  return {std::move(a), std::move(b), std::move(c)};
}

/// Whether doubles hold the grid's size and its step without getting near their ends.
inline bool doubles_hold(const Geometry& geometry) {
  constexpr long kMost = 400;
  const long step = static_cast<long>(mpz_sizeinbase(geometry.step.get_num_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(geometry.step.get_den_mpz_t(), 2));
  return geometry.grid.bits() <= kMost && std::abs(step) <= kMost;
}

/// The same in doubles, off by a few u of the grid's size for planes that cut it. Requires:
/// doubles_hold().
inline std::array<std::array<double, 3>, 3> near_points_of(const GridPlane& plane, unsigned bits) {
  using grid_plane_detail::near_quotient;
  const grid_plane_detail::Axes axes = grid_plane_detail::axes_of(plane);
  const mpz_class& largest = plane.n[axes.largest];
  const double size = std::ldexp(1.0, static_cast<int>(bits));
  const double at_corner = near_quotient(plane.d, largest);
  std::array<double, 3> a{}, b{}, c{};
  a[axes.largest] = at_corner;
  b[axes.first] = size;
  b[axes.largest] = at_corner - size * near_quotient(plane.n[axes.first], largest);
  c[axes.second] = size;
  c[axes.largest] = at_corner - size * near_quotient(plane.n[axes.second], largest);
  if (largest < 0) std::swap(b, c);
  return {a, b, c};
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_GRID_PLANE_POINTS_H
