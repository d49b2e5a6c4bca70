// SPDX-License-Identifier: LGPL-3.0-or-later
// The planes through a light and an input edge, and the side that an input vertex has of one, in
// integers: light space without q where q is wider than what is asked (orientation.h).
//
// A point light's shadow plane is q_a x q_b with q = L - v. For a directional light d every
// component of q_a x q_b has the factor d_z, and det(q_a, q_b, q_c) even d_z^2, which say nothing
// but their sign: without them, planes are e bits narrower, and a side 2e.
//
// Exactness: exact if the types hold the bits that precision_plan.h states (edge_plane_bits(),
// side_of_edge_bits()). Reference: docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_EXACT_SHADOW_PLANE_H
#define GNOMON_KERNEL_IMPLICIT_EXACT_SHADOW_PLANE_H

#include "kernel/numbers/exact_integer.h"

namespace gnomon {

/// q_a x q_b for the light at l. Requires: differences of positions fit into Position.
template <class Plane, class Position>
Vector3<Plane> point_shadow_plane(const Vector3<Position>& l, const Vector3<Position>& a,
                                  const Vector3<Position>& b) {
  return cross<Plane>(difference(l, a), difference(l, b));
}

/// (q_a x q_b) / |d_z|, where z is the component of d that the light's axes call so, and d, a, b
/// have their axes permuted like q: (v_a - v_b, u_b - u_a, d . (a x b)) times the sign of d_z, with
/// u = x d_z - z d_x and v = y d_z - z d_y.
template <class Plane, class Position>
Vector3<Plane> directional_shadow_plane(const Vector3<Position>& d, const Vector3<Position>& a,
                                        const Vector3<Position>& b) {
  const Vector3<Position> step = difference(a, b);
  Vector3<Plane> plane = {
      Plane(multiply<Plane>(step[1], d[2]) - multiply<Plane>(step[2], d[1])),
      Plane(multiply<Plane>(step[2], d[0]) - multiply<Plane>(step[0], d[2])),
      dot<Plane>(d, cross<Product<Plane, Position, Position>>(a, b)),
  };
  if (sign_of(d[2]) == Sign::kNegative) {
    for (Plane& x : plane) x = -x;
  }
  return plane;
}

/// Sign of det(q_a, q_b, q_c): the side that vertex c has of the shadow plane of edge a, b. Degree
/// 3, or 2 and 1 in the direction. Any common order of axes. Requires: as sign_of_determinant().
template <class Int, class Position>
Sign side_of_shadow_plane(bool directional, const Vector3<Position>& light,
                          const Vector3<Position>& a, const Vector3<Position>& b,
                          const Vector3<Position>& c) {
  if (directional) return sign_of_determinant<Int>(light, difference(b, a), difference(c, a));
  return sign_of_determinant<Int>(difference(light, a), difference(light, b), difference(light, c));
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_EXACT_SHADOW_PLANE_H
