// SPDX-License-Identifier: LGPL-3.0-or-later
// The grid's positions and the support planes as integers of any width: where every exact decision
// of kernel `plane` starts from.
//
// Exactness: exact if the integers hold the bits that precision_plan.h states for what is asked.
#ifndef GNOMON_KERNEL_IMPLICIT_EXACT_GEOMETRY_H
#define GNOMON_KERNEL_IMPLICIT_EXACT_GEOMETRY_H

#include <cstdint>
#include <type_traits>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/precision_plan.h"
#include "kernel/numbers/exact_integer.h"

namespace gnomon {

/// The narrowest integers of so many signed bits; GMP's if what goes in is not of fixed width.
constexpr IntegerWidth width_of(bool fixed, unsigned signed_bits) {
  return fixed ? narrowest_width(signed_bits) : IntegerWidth::kUnbounded;
}

/// How positions on a grid of 64 bits go into a computation in Int: as GMP's integers, or in 64
/// bits.
template <class Int>
using PositionFor = std::conditional_t<std::is_same_v<Int, mpz_class>, mpz_class, std::int64_t>;

/// A plane with exact integer coefficients on the grid: n . x - d.
template <class Int>
struct ExactPlane {
  Vector3<Int> n;
  Int d;
};

/// Reads the grid's integers as Int. Requires: what is asked for fits into Int; the grid is narrow
/// for std::int64_t.
template <class Int>
class ExactGeometry {
 public:
  explicit ExactGeometry(const Geometry& geometry) : geometry_(&geometry) {}

  Vector3<Int> position(VertexId v) const {
    const GridPositions& grid = geometry_->grid;
    if constexpr (std::is_same_v<Int, std::int64_t>) {
      const std::int64_t* at = grid.narrow_point(v);
      return {at[0], at[1], at[2]};
    } else if (grid.is_narrow()) {
      return {integer_from<Int>(grid.narrow(v, 0)), integer_from<Int>(grid.narrow(v, 1)),
              integer_from<Int>(grid.narrow(v, 2))};
    } else {
      return {integer_from<Int>(grid.wide(v, 0)), integer_from<Int>(grid.wide(v, 1)),
              integer_from<Int>(grid.wide(v, 2))};
    }
  }
  /// n: support_normal_bits(); d = n . a: support_value_bits().
  ExactPlane<Int> plane(PlaneId id) const {
    const Vector3<Int> n = normal<Int>(id);
    return {n, dot(n, position(geometry_->planes[id].a))};
  }
  /// n alone, kept in Normal. Requires: Int holds positions, Normal one bit more than
  /// support_normal_bits().
  template <class Normal>
  Vector3<Normal> normal(PlaneId id) const {
    const SupportTriple& triple = geometry_->planes[id];
    const Vector3<Int> a = position(triple.a);
    return cross<Normal>(difference(position(triple.b), a), difference(position(triple.c), a));
  }
  /// n . (x - a) of a support plane at an input vertex: side_of_support_bits().
  Int value(PlaneId id, VertexId v) const {
    if constexpr (!std::is_same_v<Int, mpz_class>) {
      if (geometry_->grid.is_narrow()) return value_from<std::int64_t>(id, v);
    }
    return value_from<Int>(id, v);
  }

 private:
  template <class Factor>
  Int value_from(PlaneId id, VertexId v) const {
    const ExactGeometry<Factor> exact(*geometry_);
    const SupportTriple& triple = geometry_->planes[id];
    const Vector3<Factor> a = exact.position(triple.a);
    return determinant<Int>(difference(exact.position(v), a),
                            difference(exact.position(triple.b), a),
                            difference(exact.position(triple.c), a));
  }

  const Geometry* geometry_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_EXACT_GEOMETRY_H
