// SPDX-License-Identifier: LGPL-3.0-or-later
// Three points of a plane of the grid, for kernels that make planes of points.
#ifndef GNOMON_KERNEL_CONCEPT_GRID_PLANE_POINTS_H
#define GNOMON_KERNEL_CONCEPT_GRID_PLANE_POINTS_H

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <utility>

#include "kernel/concept/image_space.h"

namespace gnomon {

/// Points a, b, c with (b - a) x (c - a) along the plane's normal. Two of their coordinates are
/// corners of the square of 2^bits, a grid's size, and the third is across the normal's largest
/// component: for planes that cut a scene of this grid the points are as far apart as the scene is
/// large, so that rounding them turns the plane little. Exact.
inline std::array<std::array<mpq_class, 3>, 3> points_of(const GridPlane& plane, unsigned bits) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(plane.n[i]) > abs(plane.n[k])) k = i;
  }
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const mpz_class size = mpz_class(1) << bits;
  const auto point = [&](const mpz_class& at_i, const mpz_class& at_j) {
    std::array<mpq_class, 3> x;
    x[i] = at_i;
    x[j] = at_j;
    x[k] = mpq_class(plane.d - plane.n[i] * at_i - plane.n[j] * at_j, plane.n[k]);
    x[k].canonicalize();
    return x;
  };
  std::array<mpq_class, 3> a = point(0, 0), b = point(size, 0), c = point(0, size);
  // Their normal is n over its largest component.
  if (plane.n[k] < 0) std::swap(b, c);
  return {std::move(a), std::move(b), std::move(c)};
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_GRID_PLANE_POINTS_H
