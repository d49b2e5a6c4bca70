// SPDX-License-Identifier: LGPL-3.0-or-later
// The integers of one light's space: the light, the map q, and the planes through the light, each
// formula once with the integer type as its parameter.
//
// Exactness: exact if the types hold the bits that precision_plan.h states; the members give those
// of this scene and light. Reference: orientation.h for q; docs/exactness.md, "In light space".
#ifndef GNOMON_KERNEL_IMPLICIT_LIGHT_INTEGERS_H
#define GNOMON_KERNEL_IMPLICIT_LIGHT_INTEGERS_H

#include <array>
#include <cstdint>

#include "gnomon/kernel/geometry.h"
#include "kernel/concept/light_space.h"
#include "kernel/implicit/exact_geometry.h"
#include "kernel/implicit/exact_shadow_plane.h"

namespace gnomon {

struct LightIntegers {
  LightIntegers(const Geometry& scene, const LightPoint& point);

  const Geometry* geometry;
  LightPoint light;
  LightAxes axes;
  unsigned light_bits;  // magnitude bits of the light's coordinates
  unsigned q_bits;      // magnitude bits of q
  unsigned side_bits;   // signed bits of the side of an edge plane of an input vertex
  unsigned edge_bits;   // magnitude bits of an edge plane
  unsigned cut_bits;    // magnitude bits of a cut of two support planes
  bool narrow;          // grid and light fit into 64 bits
  std::array<std::int64_t, 3> narrow_light{};  // the light, if narrow

  unsigned grid_bits() const { return geometry->grid.bits(); }

  /// The light's position, or its direction. Requires: narrow, unless Int is GMP's.
  template <class Int>
  Vector3<Int> position() const {
    if constexpr (std::is_same_v<Int, mpz_class>) {
      return light.grid;
    } else {
      return {integer_from<Int>(narrow_light[0]), integer_from<Int>(narrow_light[1]),
              integer_from<Int>(narrow_light[2])};
    }
  }
  /// q of an input vertex: q_bits.
  template <class Int>
  Vector3<Int> q(VertexId v) const {
    const Vector3<Int> p = ExactGeometry<Int>(*geometry).position(v), l = position<Int>();
    if (!light.directional) return difference(l, p);
    const auto [x, y, z] = axes;
    return {Int(p[x] * l[z] - p[z] * l[x]), Int(p[y] * l[z] - p[z] * l[y]), l[z]};
  }
  /// The shadow plane of an edge: edge_bits.
  template <class Int>
  Vector3<Int> edge_normal(const EdgeEnds& ends) const {
    using Position = PositionFor<Int>;
    const ExactGeometry<Position> exact(*geometry);
    const Vector3<Position> l = position<Position>();
    const Vector3<Position> a = exact.position(ends.a), b = exact.position(ends.b);
    if (!light.directional) return point_shadow_plane<Int>(l, a, b);
    return directional_shadow_plane<Int>(permuted(l), permuted(a), permuted(b));
  }
  /// The plane through the light and the line in which plane i, a support plane, is cut by plane j;
  /// positive on the part of i in front of j: cut_bits for support planes.
  template <class Int>
  Vector3<Int> cut_normal(const ExactPlane<Int>& i, const ExactPlane<Int>& j) const;
  /// A plane of this light in three dimensions, any integers.
  ExactPlane<mpz_class> in_scene(const Vector3<mpz_class>& normal) const;

 private:
  template <class Int>
  Vector3<Int> permuted(const Vector3<Int>& v) const {
    return {v[axes.x], v[axes.y], v[axes.z]};
  }
};

// Point light: P_j(v) = P_j(L) - n_j . q, and on plane i n_i . q = P_i(L), so that P_i(L) P_j(v) =
// (P_j(L) n_i - P_i(L) n_j) . q, with P_i(L) made positive. Directional light with H = n . d > 0
// for i: H_i P_j - H_j P_i is constant along d; in q coordinates it is (N_x, N_y, -o) . q / d_z, N
// = H_i n_j - H_j n_i, o = H_i d_j - H_j d_i.
template <class Int>
Vector3<Int> LightIntegers::cut_normal(const ExactPlane<Int>& i, const ExactPlane<Int>& j) const {
  const Vector3<Int> l = position<Int>();
  Int hi = dot(i.n, l), hj = dot(j.n, l);
  Vector3<Int> normal;
  if (!light.directional) {
    hi = hi - i.d;
    hj = hj - j.d;
    for (int k = 0; k < 3; ++k) normal[k] = hj * i.n[k] - hi * j.n[k];
  } else {
    normal[0] = hi * j.n[axes.x] - hj * i.n[axes.x];
    normal[1] = hi * j.n[axes.y] - hj * i.n[axes.y];
    normal[2] = hj * i.d - hi * j.d;
  }
  // Plane i oriented to the light, and d_z positive.
  const bool flip = (sign_of(hi) == Sign::kNegative) !=
                    (light.directional && sign_of(l[axes.z]) == Sign::kNegative);
  if (flip) {
    for (Int& x : normal) x = -x;
  }
  return normal;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_LIGHT_INTEGERS_H
