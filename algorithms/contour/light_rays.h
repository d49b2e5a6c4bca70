// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene in the light space of one light, as numbers: the ray of every vertex, the line of every
// edge, the depth of every support plane.
//
// The ray of a vertex is q of orientation.h, scaled; of an edge from a to b it is linear in t, a +
// t (b - a). The line of the edge is q_a x q_b, computed as q_a x (q_b - q_a) from differences that
// are exact before they are rounded, so that short edges lose nothing. It is made once an edge, in
// the edge's own direction: both polygons at an edge see the same bits, up to the sign.
//
// The depth of a plane is a linear function of rays that is larger where the plane is nearer to the
// light. Of a point light it is n / h, so that it is 1 at the vertices of the plane itself (q is
// the vector to the light); of a directional one it is the height towards the light.
#ifndef GNOMON_ALGORITHMS_CONTOUR_LIGHT_RAYS_H
#define GNOMON_ALGORITHMS_CONTOUR_LIGHT_RAYS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "algorithms/contour/numbers.h"
#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/sign.h"
#include "kernel/concept/light_space.h"
#include "kernel/implicit/light_integers.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon {

/// The bounds of the certified numbers, u = 2^-53. Tests: tests/algorithms/contour_bounds_test.cc.
struct ContourBounds {
  static constexpr double kUnit = Ball::kUnit;
  /// Of a ray's component and of a difference of rays, relative: integers, converted once (GMP
  /// truncates).
  static constexpr double kRay = 2 * kUnit;
  /// Of n . r for n = a x d with |a_k| <= A, |d_k| <= D, |r_k| <= R, in units of A D R. A product
  /// a_k d_l is off by 2u + 2u from its factors and u from rounding, two of them by 10u A D, and
  /// their difference rounds by 2u A D: a component of n, at most 2 A D, is off by 12u A D. Three
  /// of them: 36u; r: 3 * 2 * 2u = 12u; roundings of three products 6u and of sums of two and three
  /// of them 4u + 6u. 64u, and slack for terms of second order.
  static constexpr double kLine = 66 * kUnit;
  /// Of depth . r with components of depth off by 8u M (LightBounds::kDepthPlane), |r_k| <= R, in
  /// units of M R: 3 (8u + 2u) from the operands, roundings 3u + 2u + 3u. 38u.
  static constexpr double kDepth = 40 * kUnit;
};

template <class Numbers>
struct LightRays {
  using T = typename Numbers::T;

  bool directional = false;
  std::vector<Vector<T>> rays;      // by VertexId
  std::vector<Vector<T>> lines;     // by EdgeId, from its a to its b
  std::vector<double> line_error;   // certified: of n . r for |r_k| <= 1; rounded: the thickness
  std::vector<Vector<T>> depths;    // by PlaneId; nothing where the light is in the plane
  std::vector<double> depth_error;  // certified: of depth . r for |r_k| <= 1; infinite: unknown
};

namespace contour_detail {

/// q of a point p as seen from a light l, in a kernel's own numbers; see orientation.h.
template <class T>
Vector<T> ray_of(bool directional, const LightAxes& axes, const Vector<T>& l, const Vector<T>& p) {
  if (!directional) return {T(l[0] - p[0]), T(l[1] - p[1]), T(l[2] - p[2])};
  const auto [x, y, z] = axes;
  return {T(p[x] * l[z] - p[z] * l[x]), T(p[y] * l[z] - p[z] * l[y]), l[z]};
}

template <class T>
Vector<T> difference_of(const Vector<T>& a, const Vector<T>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}

/// Positions and the light in a kernel's own numbers: rationals on the grid, or rounded and scaled
/// by a power of two to a size of 1, so that products of three of them neither over- nor underflow.
template <class T>
class ScaledScene {
 public:
  ScaledScene(const Geometry& geometry, const LightPoint& light) : geometry_(geometry) {
    if constexpr (!std::is_same_v<T, mpq_class>) {
      double most = 0, most_of_light = 0;
      for (const std::array<double, 3>& p : geometry.positions) most = std::max(most, largest(p));
      most_of_light = largest(light.nearest);
      if (!light.directional) most = most_of_light = std::max(most, most_of_light);
      scale_ = power_below(most);
      light_scale_ = power_below(most_of_light);
    }
    for (int k = 0; k < 3; ++k) {
      if constexpr (std::is_same_v<T, mpq_class>) {
        light_[k] = light.grid[k];
      } else {
        light_[k] = static_cast<T>(light.nearest[k] * light_scale_);
      }
    }
  }
  Vector<T> position(VertexId v) const {
    Vector<T> p;
    for (int k = 0; k < 3; ++k) {
      if constexpr (std::is_same_v<T, mpq_class>) {
        p[k] = geometry_.grid.at(v, k);
      } else {
        p[k] = static_cast<T>(geometry_.positions[v][k] * scale_);
      }
    }
    return p;
  }
  const Vector<T>& light() const { return light_; }
  double scale() const { return scale_; }

 private:
  static double power_below(double size) {
    return size > 0x1p-900 && size < 0x1p900 ? std::ldexp(1.0, -std::ilogb(size)) : 1;
  }
  const Geometry& geometry_;
  double scale_ = 1, light_scale_ = 1;
  Vector<T> light_;
};

}  // namespace contour_detail

/// Rays, lines and depths in rationals or in a rounded kernel's numbers, into arrays that are kept
/// from light to light. `thickness` in scene units, 0 for exact numbers: what is so near to a plane
/// is on it.
template <class Numbers>
void make_light_rays(const Geometry& geometry, const LightPoint& light, double thickness,
                     LightRays<Numbers>& result) requires(!Numbers::kCertified) {
  using T = typename Numbers::T;
  using namespace contour_detail;
  result.directional = light.directional;
  const LightAxes axes = LightAxes::of(light);
  const ScaledScene<T> scaled(geometry, light);
  const Vector<T>& l = scaled.light();
  thickness *= scaled.scale();
  result.rays.resize(geometry.positions.size());
  for (VertexId v = 0; v < result.rays.size(); ++v) {
    result.rays[v] = ray_of(light.directional, axes, l, scaled.position(v));
  }
  result.lines.resize(geometry.edges.size());
  result.line_error.assign(geometry.edges.size(), 0);
  for (EdgeId e = 0; e < geometry.edges.size(); ++e) {
    const auto [from, to] = geometry.edges[e];
    const Vector<T>& a = result.rays[from];
    result.lines[e] = cross_product(a, difference_of(result.rays[to], a));
    if constexpr (!Numbers::kExact) {
      if (thickness == 0) continue;
      // A value of the line is a distance from its plane times this.
      Vector<T> normal = result.lines[e];
      if (light.directional) {
        normal = cross_product(difference_of(scaled.position(to), scaled.position(from)), l);
        for (T& x : normal) x *= l[axes.z] * l[axes.z];
      }
      result.line_error[e] =
          thickness * static_cast<double>(std::sqrt(dot_product(normal, normal)));
    }
  }
  result.depths.resize(geometry.planes.size());
  result.depth_error.assign(geometry.planes.size(), 0);
  for (PlaneId id = 0; id < geometry.planes.size(); ++id) {
    const SupportTriple& triple = geometry.planes[id];
    const Vector<T> a = scaled.position(triple.a);
    const Vector<T> n = cross_product(difference_of(scaled.position(triple.b), a),
                                      difference_of(scaled.position(triple.c), a));
    const T height = light.directional ? dot_product(n, l) : dot_product(n, difference_of(l, a));
    if (sign_of_value(height) == 0) continue;
    T unit = 1;  // of depths, in scene units along the normal
    if (!light.directional) {
      for (int k = 0; k < 3; ++k) result.depths[id][k] = T(n[k] / height);
    } else {
      const auto [x, y, z] = axes;
      unit = sign_of_value(l[z]) < 0 ? -1 : 1;
      result.depths[id] = {T(-unit * n[x] / height), T(-unit * n[y] / height),
                           T(unit * dot_product(n, a) / height)};
      unit = l[z];
    }
    if constexpr (!Numbers::kExact) {
      const T size = std::sqrt(dot_product(n, n)) * unit / height;
      result.depth_error[id] = thickness * std::fabs(static_cast<double>(size));
    }
  }
}

namespace contour_detail {

/// Rays and lines from integers of the type Int, scaled by 2^-scale; of a directional light the
/// third component is d_z 2^b times that, as in the light space of kernel `plane`.
template <class Int>
void fill_certified(const LightIntegers& light,
                    LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  const Geometry& geometry = *light.geometry;
  const bool directional = light.light.directional;
  const auto scaled = [&, scale = std::ldexp(1.0, -static_cast<int>(light.q_bits))](const Int& x) {
    if constexpr (std::is_same_v<Int, std::int64_t> || std::is_same_v<Int, Int128>) {
      return static_cast<double>(x) * scale;
    } else {
      return to_double_scaled(x, static_cast<long>(light.q_bits));
    }
  };
  double third = 0;
  if (directional) {
    third =
        to_double_scaled(light.position<Int>()[light.axes.z],
                         static_cast<long>(light.q_bits) - static_cast<long>(light.grid_bits()));
  }
  for (VertexId v = 0; v < result.rays.size(); ++v) {
    const Vector3<Int> q = light.q<Int>(v);
    result.rays[v] = {scaled(q[0]), scaled(q[1]), directional ? third : scaled(q[2])};
  }
  // Rays of at most 52 bits are exactly their doubles, and so are the differences of two.
  const bool exact_rays = light.narrow && light.q_bits <= 52;
  for (EdgeId e = 0; e < geometry.edges.size(); ++e) {
    const auto [from, to] = geometry.edges[e];
    const Vector<double>& a = result.rays[from];
    Vector<double> d{0, 0, 0};
    if (exact_rays) {
      d = difference_of(result.rays[to], a);
    } else {
      const Vector3<Int> difference = gnomon::difference(light.q<Int>(to), light.q<Int>(from));
      for (int k = 0; k < (directional ? 2 : 3); ++k) d[k] = scaled(difference[k]);
    }
    result.lines[e] = cross_product(a, d);
    result.line_error[e] = ContourBounds::kLine * largest(a) * largest(d);
  }
}

}  // namespace contour_detail

/// Rays, lines and depths in doubles with bounds, from the integers and the depth planes of kernel
/// `plane`.
template <class Space>
void make_light_rays(const Space& space, const Geometry& geometry, const LightPoint& light,
                     LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  const LightIntegers integers(geometry, light);
  result.directional = light.directional;
  result.rays.resize(geometry.positions.size());
  result.lines.resize(geometry.edges.size());
  result.line_error.resize(geometry.edges.size());
  with_width(width_of(integers.narrow, integers.q_bits + 2),
             [&]<class Int>() { contour_detail::fill_certified<Int>(integers, result); });
  result.depths.resize(geometry.planes.size());
  result.depth_error.resize(geometry.planes.size());
  for (PlaneId id = 0; id < geometry.planes.size(); ++id) {
    const auto& plane = space.depth_plane(id);
    result.depths[id] = plane.n;
    result.depth_error[id] = ContourBounds::kDepth * plane.magnitude;
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_LIGHT_RAYS_H
