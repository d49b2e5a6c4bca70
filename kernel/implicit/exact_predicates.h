// SPDX-License-Identifier: LGPL-3.0-or-later
// The predicates about points that are never constructed, stated once for all spaces and all
// integers: the side that a plane has at the point of an edge and a plane, or of three planes.
//
// A plane is known by its values P(o) = n . o - d at points o of the scene and by its normal. The
// point is a quotient of which only signs matter, so that each sign is one polynomial in these.
//
// Exactness: exact if the integers hold the bits that precision_plan.h states. Reference:
// docs/exactness.md, "Bits of the exact stage".
#ifndef GNOMON_KERNEL_IMPLICIT_EXACT_PREDICATES_H
#define GNOMON_KERNEL_IMPLICIT_EXACT_PREDICATES_H

#include <array>
#include <cstddef>

#include "kernel/numbers/exact_integer.h"

namespace gnomon {

/// Sign of plane Q at the point where the edge from u to v meets plane P: positive in front of Q,
/// zero on it, negative behind. The point is (P(v) u - P(u) v) / (P(v) - P(u)), so that Q there is
/// (P(v) Q(u) - P(u) Q(v)) over the same.
/// Requires: P(u) and P(v) differ; two bits more than two values together fit into Int, one bit
/// more than a value into Value. Degree: 6 for support planes. Bits: volume_edge_bits(), of which
/// edge_against_plane_bits() is the case of support planes.
template <class Int, class Value>
Sign sign_at_edge_point(const Value& p_u, const Value& p_v, const Value& q_u, const Value& q_v) {
  return sign_of(Int(multiply<Int>(p_v, q_u) - multiply<Int>(p_u, q_v))) *
         sign_of(Value(p_v - p_u));
}

/// Sign of plane T at the point where planes P, Q, R with normals n[0], n[1], n[2] meet, from the
/// values of all four at any point o: positive in front of T, zero on it, negative behind. The
/// point is o - (P(o) q x r + Q(o) r x p + R(o) p x q) / w with w = p . q x r, and T there is (T(o)
/// w - P(o) t . q x r - Q(o) t . r x p - R(o) t . p x q) / w. Where o lies in all but one of the
/// four planes, only signs of products are left. Requires: the three planes meet in one point;
/// components leave two bits of Factor free, and values fit into the product of two Factors.
/// Degree: 9 for support planes. Bits: volume_meet_bits(), of which four_planes_bits() is the case
/// of support planes.
template <class Int, class Factor, class Value>
Sign sign_at_meet(const std::array<Vector3<Factor>, 3>& n, const std::array<Value, 3>& values,
                  const Vector3<Factor>& t, const Value& t_value) {
  using Cross = Product<Int, Factor, Factor>;
  using Minor = Product<Int, Factor, Cross>;
  Value sole{};
  Minor sole_minor{};
  Int sum{};
  int terms = 0;
  const auto add = [&](const Value& value, const Minor& minor) {
    if (terms == 0) {
      sole = value;
      sole_minor = minor;
    } else {
      if (terms == 1) sum = multiply<Int>(sole, sole_minor);
      sum = Int(sum + multiply<Int>(value, minor));
    }
    ++terms;
  };
  const Minor w = dot<Minor>(n[0], cross<Cross>(n[1], n[2]));
  for (std::size_t i = 0; i < 3; ++i) {
    if (sign_of(values[i]) == Sign::kZero) continue;
    // t . n_(i+1) x n_(i+2) with its sign turned.
    add(values[i], dot<Minor>(t, cross<Cross>(n[(i + 2) % 3], n[(i + 1) % 3])));
  }
  if (sign_of(t_value) != Sign::kZero) add(t_value, w);
  const Sign sign = terms == 0   ? Sign::kZero
                    : terms == 1 ? sign_of(sole) * sign_of(sole_minor)
                                 : sign_of(sum);
  return sign * sign_of(w);
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_EXACT_PREDICATES_H
