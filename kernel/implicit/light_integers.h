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
  bool far;             // a lamp of kFarBits: its doubles are those of a sun, nearly
  bool narrow;          // grid and light fit into 64 bits, and their differences
  std::array<std::int64_t, 3> narrow_light{};  // the light, if narrow

  /// A lamp whose coordinates have so many bits more than those of vertices is far: seen from the
  /// scene it shines along its position, but for 2^-kFarBits. Its rays are as a sun's then
  /// (far_ray()), so that doubles of them have the scene's size, and not only that of its distance.
  static constexpr unsigned kFarBits = 12;

  unsigned grid_bits() const { return geometry->grid.bits(); }
  /// Whether doubles are those of a sun, or nearly.
  bool is_parallel() const { return light.directional || far; }

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
    if (far) return cross<Int>(difference(l, a), difference(a, b));
    if (!light.directional) return point_shadow_plane<Int>(l, a, b);
    return directional_shadow_plane<Int>(permuted(l), permuted(a), permuted(b));
  }
  /// Of a far lamp L, with z the axis of its largest coordinate, a ray is r = (x L_z - z L_x, y L_z
  /// - z L_y, L_z - z): a sun's q, but for the z in its third component, and a linear map of q = L
  /// - v with the determinant L_z^2. grid_bits() + light_bits + 1 bits, the third light_bits + 1.
  template <class Int>
  Vector3<Int> far_ray(VertexId v) const {
    const Vector3<Int> p = permuted(ExactGeometry<Int>(*geometry).position(v)),
                       l = permuted(position<Int>());
    return {Int(p[0] * l[2] - p[2] * l[0]), Int(p[1] * l[2] - p[2] * l[1]), Int(l[2] - p[2])};
  }
  /// A plane n . q of a far lamp in its rays, (-n_x, -n_y, n . L) with the sign of L_z: the plane's
  /// normal in the scene, and its offset. The opposite way: the plane in q of one in rays, times
  /// |L_z|.
  Vector3<mpz_class> in_far_rays(const Vector3<mpz_class>& n) const;
  Vector3<mpz_class> from_far_rays(const Vector3<mpz_class>& n) const;
  /// in_far_rays() of an edge_normal(): its offset is L . (a x b), 2 grid_bits() + light_bits + 2.
  template <class Int>
  Vector3<Int> far_edge_plane(const EdgeEnds& ends) const {
    using Position = PositionFor<Int>;
    const ExactGeometry<Position> exact(*geometry);
    const Vector3<Position> l = permuted(position<Position>());
    const Vector3<Position> a = permuted(exact.position(ends.a)),
                            b = permuted(exact.position(ends.b));
    Vector3<Int> plane = cross<Int>(difference(l, a), difference(b, a));
    plane[2] = dot<Int>(l, cross<Product<Int, Position, Position>>(a, b));
    if (sign_of(l[2]) == Sign::kNegative) {
      for (Int& x : plane) x = -x;
    }
    return plane;
  }
  /// The plane through the light and the line in which plane i, a support plane, is cut by plane j;
  /// positive on the part of i in front of j: cut_bits for support planes.
  template <class Int>
  Vector3<Int> cut_normal(const ExactPlane<Int>& i, const ExactPlane<Int>& j) const;
  /// The same of two support planes, each factor kept as narrow as it is.
  template <class Int>
  Vector3<Int> cut_of_supports(PlaneId i, PlaneId j) const;
  /// A plane of this light in three dimensions, any integers.
  ExactPlane<mpz_class> in_scene(const Vector3<mpz_class>& normal) const;

 private:
  template <class Int, class Normal, class Value>
  Vector3<Int> cut_of_narrow(PlaneId i, PlaneId j) const;
  /// Whether a cut of plane i, of this value at the light, is the opposite of what its formula
  /// says: plane i is oriented to the light, and d_z positive.
  bool flips_cut(Sign at_light) const {
    return (at_light == Sign::kNegative) != (light.directional && sgn(light.grid[axes.z]) < 0);
  }
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
  if (flips_cut(sign_of(hi))) {
    for (Int& x : normal) x = -x;
  }
  return normal;
}

template <class Int>
Vector3<Int> LightIntegers::cut_of_supports(PlaneId i, PlaneId j) const {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    const ExactGeometry<Int> exact(*geometry);
    return cut_normal(exact.plane(i), exact.plane(j));
  } else {
    // Values at the light, 2 D^3 of a box that holds it or 3 D^2 E, and at the grid's corner.
    const unsigned b = grid_bits();
    const unsigned at_light = is_parallel() ? 2 * b + light_bits + 2 : support_value_bits(q_bits);
    const unsigned value_bits = std::max(at_light, support_value_bits(b));
    Vector3<Int> result;
    with_factor<Int>(support_normal_bits(b) + 1, [&]<class Normal>() {
      with_factor<Int>(value_bits, [&]<class Value>() {
        // Values have more bits than normals.
        if constexpr (kLimbsOf<Normal> <= kLimbsOf<Value>) {
          result = cut_of_narrow<Int, Normal, Value>(i, j);
        }
      });
    });
    return result;
  }
}

// As cut_normal().
template <class Int, class Normal, class Value>
Vector3<Int> LightIntegers::cut_of_narrow(PlaneId i, PlaneId j) const {
  const ExactGeometry<std::int64_t> exact(*geometry);
  const Vector3<std::int64_t> l = position<std::int64_t>();
  const Vector3<std::int64_t> a_i = exact.position(geometry->planes[i].a),
                              a_j = exact.position(geometry->planes[j].a);
  const Vector3<Normal> n_i = exact.normal<Normal>(i), n_j = exact.normal<Normal>(j);
  const bool directional = light.directional;
  const Value h_i = dot<Value>(n_i, directional ? l : difference(l, a_i));
  const Value h_j = dot<Value>(n_j, directional ? l : difference(l, a_j));
  const auto minor = [&](const auto& of_i, const auto& of_j) {
    return Int(multiply<Int>(h_j, of_i) - multiply<Int>(h_i, of_j));
  };
  Vector3<Int> normal;
  if (!directional) {
    for (std::size_t k = 0; k < 3; ++k) normal[k] = minor(n_i[k], n_j[k]);
  } else {
    normal[0] = -minor(n_i[axes.x], n_j[axes.x]);
    normal[1] = -minor(n_i[axes.y], n_j[axes.y]);
    normal[2] = minor(dot<Value>(n_i, a_i), dot<Value>(n_j, a_j));
  }
  if (flips_cut(sign_of(h_i))) {
    for (Int& x : normal) x = -x;
  }
  return normal;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_LIGHT_INTEGERS_H
