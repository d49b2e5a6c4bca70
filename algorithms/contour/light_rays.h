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
//
// A far lamp (LightIntegers::far) has the rays of LightIntegers::far_ray(), which are a sun's but
// for what the third component loses with the height z of the vertex, and its depths are heights.
// All that a sun's numbers are is the same for it, and its bounds differ by what that component is
// off by; only areas need to know that it is no sun: the quotient n / h is 1 + perspective (height
// - z).
#ifndef GNOMON_ALGORITHMS_CONTOUR_LIGHT_RAYS_H
#define GNOMON_ALGORITHMS_CONTOUR_LIGHT_RAYS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "algorithms/contour/contour_bounds.h"
#include "algorithms/contour/edge_planes.h"
#include "algorithms/contour/exact_values.h"
#include "algorithms/contour/far_apex.h"
#include "algorithms/contour/numbers.h"
#include "algorithms/contour/scaled_scene.h"
#include "algorithms/partition/in_parallel.h"
#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/orientation.h"
#include "gnomon/kernel/sign.h"
#include "kernel/concept/light_space.h"
#include "kernel/implicit/light_integers.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon {

template <class Numbers>
struct LightRays {
  using T = typename Numbers::T;

  bool directional = false;
  /// Depths are heights, of a sun or a far lamp; else they are 1 at a plane's own vertices.
  bool of_heights = false;
  /// Of a far lamp: the height of each vertex as its own plane's depth has it, and the factor of
  /// what another plane's depth has more. heights is empty for all other lights.
  std::vector<T> heights;
  T perspective{};
  double nearness = 0;  // certified, of a far lamp: of z in the third component of a ray
  /// Certified, of a sun or a far lamp: positions as doubles, exactly, scaled to [0, 1], along the
  /// axes of its rays; empty where they are no doubles.
  std::vector<Vector<double>> positions;
  std::array<int, 3> axes{0, 1, 2};  // of positions
  Vector<double> to_light{};         // of a sun or far lamp, as rays have it, along the same axes

  /// Certified: the plane of each edge. None where the grid is wide, and of a lamp's exact rays,
  /// whose lines are no worse where they are not exact, either.
  EdgePlanes planes;

  /// Certified: the line from a to b at v, and what that is off by: det(r_a, r_b, r_v), for a sun
  /// less the factor exact->unit(). Off by at most `most` of itself, whatever cancels in it.
  double sharp_value(VertexId a, VertexId b, VertexId v, double most, double& error) const;
  /// Certified: the factor of sharp_value() in the units of integrals, which are those of lines, or
  /// of planes where there are any.
  double unit() const { return planes.empty() ? exact->unit() : 1; }
  /// What a line's value at a ray is to be divided by to be in those units.
  double unit_of_lines() const { return planes.empty() ? 1 : exact->unit(); }
  /// A bound of dot_product(line, ray) from lines and rays, or 0 if nothing can have been rounded.
  double proven(double error) const {
    return error < ContourBounds::kLine * exact_size ? 0 : error;
  }

  /// Certified: what an integral may be off by before it is found from sharper values. Bounds count
  /// the worst of all roundings. Those of lines say ten times what integrals are off by, or more;
  /// those of planes count the terms that there are, and integrals may come near them.
  double rough() const { return (!planes.empty() ? 96 : directional ? 512 : 256) * Ball::kUnit; }

  std::optional<ExactValues> exact;  // certified
  bool exact_rays = false;  // certified, of a lamp: rays are exactly their integers, scaled
  /// Certified: sums of products of integers are doubles if the product of the largest of each is
  /// below this, of two of them and of three.
  double exact_cross = 0, exact_size = 0;
  double apex_terms = 0;  // certified: of sharp_value(), in units of the sum of |apex_k c_k|
  double reach = 0;  // certified: a bound of |r_k| by which errors count; 0: that of each polygon
  std::vector<Vector<T>> rays;      // by VertexId
  std::vector<Vector<T>> lines;     // by EdgeId, from its a to its b
  std::vector<double> line_error;   // certified: of n . r for |r_k| <= 1; rounded: the thickness
  std::vector<Vector<T>> depths;    // by PlaneId; nothing where the light is in the plane
  std::vector<double> depth_error;  // certified: of depth . r for |r_k| <= 1; infinite: unknown
};

/// With c = (b - a) x (v - a) of rays, or of positions, it is r_a . c of a lamp, d . c of a sun,
/// and (d - nearness a) . c of a far lamp.
template <class Numbers>
double LightRays<Numbers>::sharp_value(VertexId a, VertexId b, VertexId v, double most,
                                       double& error) const {
  if (exact_rays || !positions.empty()) {
    const std::vector<Vector<double>>& points = exact_rays ? rays : positions;
    const Vector<double>&at = points[a], &to = points[b], &p = points[v];
    Vector<double> apex = exact_rays ? at : to_light, most_of_apex = apex;
    for (int k = 0; nearness > 0 && k < 3; ++k) {
      most_of_apex[k] = std::fabs(apex[k]) + nearness;
      apex[k] -= nearness * at[k];
    }
    const Vector<double> d{to[0] - at[0], to[1] - at[1], to[2] - at[2]};
    const Vector<double> s{p[0] - at[0], p[1] - at[1], p[2] - at[2]};
    const Vector<double> c = cross_product(d, s);
    const double size = largest(d) * largest(s);
    const double x = apex[0] * c[0], y = apex[1] * c[1], z = apex[2] * c[2];
    const double value = x + y + z;
    error = nearness > 0 ? apex_terms * (most_of_apex[0] * std::fabs(c[0]) +
                                         most_of_apex[1] * std::fabs(c[1]) +
                                         most_of_apex[2] * std::fabs(c[2]))
                         : apex_terms * (std::fabs(x) + std::fabs(y) + std::fabs(z));
    if (!(size < exact_cross)) {
      error +=
          ContourBounds::kCross * size *
          (std::fabs(most_of_apex[0]) + std::fabs(most_of_apex[1]) + std::fabs(most_of_apex[2]));
    }
    if (error <= most * std::fabs(value)) return value;
  }
  const double value = exact->line(a, b, v);
  error = ExactValues::kLine * std::fabs(value) + Ball::kTiny;  // it may have underflowed
  return value;
}

namespace contour_detail {

/// q of a point p as seen from a light l, in a kernel's own numbers; see orientation.h. Of a sun or
/// a far lamp, with the z of p as the third component has it: 0, or the unit of l.
template <class T>
Vector<T> ray_of(bool parallel, const LightAxes& axes, const Vector<T>& l, const Vector<T>& p,
                 const T& nearness) {
  if (!parallel) return {T(l[0] - p[0]), T(l[1] - p[1]), T(l[2] - p[2])};
  const auto [x, y, z] = axes;
  return {T(p[x] * l[z] - p[z] * l[x]), T(p[y] * l[z] - p[z] * l[y]), T(l[z] - nearness * p[z])};
}

template <class T>
Vector<T> difference_of(const Vector<T>& a, const Vector<T>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}

}  // namespace contour_detail

/// Rays, lines and depths in rationals or in a rounded kernel's numbers, into arrays that are kept
/// from light to light. `thickness` in scene units, 0 for exact numbers: what is so near to a plane
/// is on it.
template <class Numbers>
void make_light_rays(const Geometry& geometry, const LightPoint& light, double thickness,
                     LightRays<Numbers>& result) requires(!Numbers::kCertified) {
  using T = typename Numbers::T;
  using namespace contour_detail;
  const LightIntegers integers(geometry, light);
  const bool parallel = integers.is_parallel();
  result.directional = light.directional;
  result.of_heights = parallel;
  const LightAxes axes = integers.axes;
  const ScaledScene<T> scaled(geometry, light, integers.far);
  const Vector<T>& l = scaled.light();
  const T& nearness = scaled.nearness();
  thickness *= scaled.scale();
  result.heights.resize(integers.far ? geometry.positions.size() : 0);
  if (integers.far) result.perspective = T(nearness / (l[axes.z] < 0 ? T(-l[axes.z]) : l[axes.z]));
  result.rays.resize(geometry.positions.size());
  for (VertexId v = 0; v < result.rays.size(); ++v) {
    const Vector<T> p = scaled.position(v);
    result.rays[v] = ray_of(parallel, axes, l, p, nearness);
    if (integers.far) result.heights[v] = l[axes.z] < 0 ? T(-p[axes.z]) : p[axes.z];
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
      if (parallel) {
        const Vector<T> at = scaled.position(from);
        const Vector<T> towards{T(l[0] - nearness * at[0]), T(l[1] - nearness * at[1]),
                                T(l[2] - nearness * at[2])};
        normal = cross_product(difference_of(scaled.position(to), at), towards);
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
    const T height =
        parallel ? dot_product(n, Vector<T>{T(l[0] - nearness * a[0]), T(l[1] - nearness * a[1]),
                                            T(l[2] - nearness * a[2])})
                 : dot_product(n, difference_of(l, a));
    if (sign_of_value(height) == 0) continue;
    T unit = 1;  // of depths, in scene units along the normal
    if (!parallel) {
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

/// Vertices or edges of one thread.
inline constexpr std::uint32_t kRayGrain = 4096;
template <class Array>
std::uint32_t size_of(const Array& array) {
  return static_cast<std::uint32_t>(array.size());
}

/// Magnitude bits of the rays.
inline unsigned ray_bits(const LightIntegers& light) {
  return light.far ? light_space_bits(true, light.grid_bits(), light.light_bits) : light.q_bits;
}

/// Rays and lines from integers of the type Int, scaled by 2^-ray_bits(); of a directional light or
/// a far lamp the third component is d_z 2^b times that, as in the light space of kernel `plane`.
template <class Int>
void fill_certified(const LightIntegers& light, unsigned jobs,
                    LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  const Geometry& geometry = *light.geometry;
  const bool directional = light.light.directional;
  const unsigned bits = ray_bits(light);
  // Wide integers are scaled at once: what is small could underflow on the way.
  struct Scale {
    long shift = 0;
    double factor = std::ldexp(1.0, static_cast<int>(-shift));
  };
  const Scale scale{long{bits}};
  const Scale third_scale{long{bits} - (light.is_parallel() ? long{light.grid_bits()} : 0)};
  const auto scaled = [](const Int& x, const Scale& by) {
    if constexpr (std::is_same_v<Int, std::int64_t> || std::is_same_v<Int, Int128>) {
      return static_cast<double>(x) * by.factor;
    } else {
      return to_double_scaled(x, by.shift);
    }
  };
  const auto ray = [&](VertexId v) { return light.far ? light.far_ray<Int>(v) : light.q<Int>(v); };
  double third = 0;
  if (directional) {
    third = to_double_scaled(light.position<Int>()[light.axes.z], third_scale.shift);
  }
  in_parallel(jobs, size_of(result.rays), kRayGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (VertexId v = begin; v < end; ++v) {
      const Vector3<Int> q = ray(v);
      result.rays[v] = {scaled(q[0], scale), scaled(q[1], scale),
                        directional ? third : scaled(q[2], third_scale)};
    }
  });
  // Rays of at most 52 bits are exactly their doubles, and so are the differences of two.
  const bool exact_rays = light.narrow && bits <= 52;
  if (!light.is_parallel() && exact_rays) {
    result.exact_rays = true;
    result.exact_cross = std::ldexp(1.0, 51 - 2 * static_cast<int>(bits));
    result.exact_size = std::ldexp(1.0, 50 - 3 * static_cast<int>(bits));
    result.apex_terms = ContourBounds::kApex;
  }
  in_parallel(jobs, size_of(geometry.edges), kRayGrain,
              [&](std::uint32_t begin, std::uint32_t end) {
                for (EdgeId e = begin; e < end; ++e) {
                  const auto [from, to] = geometry.edges[e];
                  const Vector<double>& a = result.rays[from];
                  Vector<double> d{0, 0, 0};
                  if (exact_rays) {
                    d = difference_of(result.rays[to], a);
                  } else {
                    const Vector3<Int> difference = gnomon::difference(ray(to), ray(from));
                    d[0] = scaled(difference[0], scale);
                    d[1] = scaled(difference[1], scale);
                    if (!directional) d[2] = scaled(difference[2], third_scale);
                  }
                  result.lines[e] = cross_product(a, d);
                  result.line_error[e] = ContourBounds::kLine * largest(a) * largest(d);
                }
              });
}

/// Whether all components of a light are exactly doubles, whatever their common step is.
inline bool is_of_doubles(const LightPoint& light) {
  return std::ranges::all_of(light.grid, [](const mpz_class& x) {
    return x == 0 || mpz_sizeinbase(x.get_mpz_t(), 2) - mpz_scan1(x.get_mpz_t(), 0) <= 53;
  });
}

/// The same for a sun or a far lamp, from positions that are exactly doubles.
inline void fill_certified_sun(const LightIntegers& light, unsigned jobs,
                               LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  const Geometry& geometry = *light.geometry;
  const Vector<double>& d = result.to_light;
  result.reach = ContourBounds::kSunReach;
  in_parallel(jobs, size_of(result.rays), kRayGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (VertexId v = begin; v < end; ++v) {
      const Vector<double>& p = result.positions[v];
      result.rays[v] = {p[0] * d[2] - p[2] * d[0], p[1] * d[2] - p[2] * d[1],
                        d[2] - result.nearness * p[2]};
    }
  });
  in_parallel(
      jobs, size_of(geometry.edges), kRayGrain, [&](std::uint32_t begin, std::uint32_t end) {
        for (EdgeId e = begin; e < end; ++e) {
          const auto [from, to] = geometry.edges[e];
          const Vector<double>& at = result.positions[from];
          const Vector<double> step = difference_of(result.positions[to], at);
          const double size = largest(step);
          const Vector<double> of_rays{step[0] * d[2] - step[2] * d[0],
                                       step[1] * d[2] - step[2] * d[1], -result.nearness * step[2]};
          result.lines[e] = cross_product(result.rays[from], of_rays);
          result.line_error[e] =
              (light.far ? ContourBounds::kFarLine : ContourBounds::kSunLine) * size;
        }
      });
}

/// Positions as doubles, for a sun or a far lamp, where each is one. Kept from one to the next of
/// the same axes.
inline void fill_positions(const LightIntegers& light,
                           LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  constexpr unsigned kDoubleBits = 53;
  const Geometry& geometry = *light.geometry;
  const std::array<int, 3> axes{light.axes.x, light.axes.y, light.axes.z};
  for (int k = 0; k < 3; ++k) {
    result.to_light[k] =
        to_double_scaled(light.light.grid[axes[k]], static_cast<long>(light.light_bits));
  }
  if (!light.is_parallel() || geometry.grid.bits() > kDoubleBits) {
    result.positions.clear();
    return;
  }
  if (result.positions.empty() || result.axes != axes) {
    const double scale = std::ldexp(1.0, -static_cast<int>(light.grid_bits()));
    result.axes = axes;
    result.positions.resize(geometry.positions.size());
    for (VertexId v = 0; v < result.positions.size(); ++v) {
      const std::int64_t* p = geometry.grid.narrow_point(v);
      for (int k = 0; k < 3; ++k) result.positions[v][k] = static_cast<double>(p[axes[k]]) * scale;
    }
  }
}

/// The heights of vertices under a far lamp, each off by at most 2u of itself.
inline void fill_heights(const LightIntegers& light,
                         LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  result.nearness = 0;
  result.heights.clear();
  if (!light.far) return;
  const GridPositions& grid = light.geometry->grid;
  const int b = static_cast<int>(grid.bits()), e = static_cast<int>(light.light_bits);
  // Rays from integers are scaled by one bit more than those from positions, and so are depths.
  const double scale = result.positions.empty() ? 0.5 : 1;
  const double sign = result.to_light[2] < 0 ? -scale : scale;
  result.nearness = std::ldexp(1.0, b - e);
  result.perspective = result.nearness / std::fabs(result.to_light[2]) / scale;
  result.heights.resize(grid.size());
  for (VertexId v = 0; v < result.heights.size(); ++v) {
    const double z = grid.is_narrow()
                         ? std::ldexp(static_cast<double>(grid.narrow(v, light.axes.z)), -b)
                         : to_double_scaled(grid.wide(v, light.axes.z), b);
    result.heights[v] = sign * z;
  }
}

/// The planes of edges, from a narrow grid. Requires: rays and lines.
inline void fill_planes(const LightIntegers& light, unsigned jobs,
                        LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  const Geometry& geometry = *light.geometry;
  const bool directional = light.light.directional;
  const auto g = static_cast<int>(light.grid_bits()), q = static_cast<int>(light.q_bits);
  result.planes.clear();
  if (!(light.far ? geometry.grid.is_narrow() : light.narrow) || result.exact_rays) return;
  if (!result.positions.empty()) {
    result.planes.start(geometry.edges.size(), result.positions);
  } else if (light.is_parallel()) {
    const std::array<int, 3> axes{light.axes.x, light.axes.y, light.axes.z};
    result.planes.start(geometry.edges.size(), geometry.grid, axes, std::ldexp(1.0, -g));
  } else {
    // Rays are the light less positions.
    result.planes.start(geometry.edges.size(), geometry.grid, {0, 1, 2}, -std::ldexp(1.0, -q));
  }
  if (light.far) {
    result.planes.set_bounds(ContourBounds::kFarPlane, 0);
  } else if (!result.positions.empty() && g < 53 && is_of_doubles(light.light)) {
    result.planes.set_bounds(ContourBounds::kPlaneOfExact,
                             std::ldexp(1.0, 52 - 2 * g - static_cast<int>(light.light_bits)));
  } else {
    result.planes.set_bounds(ContourBounds::kPlane, 0);
  }
  std::optional<FarApex> far;
  if (light.far) far.emplace(light, result.to_light);
  in_parallel(jobs, size_of(geometry.edges), kRayGrain,
              [&](std::uint32_t begin, std::uint32_t end) {
                for (EdgeId e = begin; e < end; ++e) {
                  const EdgeEnds& ends = geometry.edges[e];
                  result.planes.set(e, ends,
                                    far           ? (*far)(ends.a)
                                    : directional ? result.to_light
                                                  : result.rays[ends.a]);
                }
              });
}

}  // namespace contour_detail

/// Rays, lines and depths in doubles with bounds, from the integers and the depth planes of kernel
/// `plane`.
template <class Space>
void make_light_rays(const Space& space, const Geometry& geometry, const LightPoint& light,
                     unsigned jobs, LightRays<ContourNumbers<double, Trust::kCertified>>& result) {
  const LightIntegers integers(geometry, light);
  result.directional = light.directional;
  result.of_heights = integers.is_parallel();
  result.rays.resize(geometry.positions.size());
  result.lines.resize(geometry.edges.size());
  result.line_error.resize(geometry.edges.size());
  result.exact_rays = false;
  result.exact_cross = result.exact_size = 0;
  contour_detail::fill_positions(integers, result);
  contour_detail::fill_heights(integers, result);
  if (!result.positions.empty()) {
    contour_detail::fill_certified_sun(integers, jobs, result);
    result.exact_cross = std::ldexp(1.0, 51 - 2 * static_cast<int>(integers.grid_bits()));
    result.apex_terms = integers.far ? ContourBounds::kFarApex : ContourBounds::kSunApex;
    result.exact.emplace(integers, integers.grid_bits() + integers.light_bits);
  } else {
    const unsigned bits = contour_detail::ray_bits(integers);
    result.exact.emplace(integers, bits);
    result.reach = 0;
    with_width(width_of(integers.narrow, bits + 2),
               [&]<class Int>() { contour_detail::fill_certified<Int>(integers, jobs, result); });
  }
  contour_detail::fill_planes(integers, jobs, result);
  result.depths.resize(geometry.planes.size());
  result.depth_error.resize(geometry.planes.size());
  constexpr unsigned kDoubleBits = 53;
  const bool exact_normals = 2 * geometry.grid.bits() + 1 <= kDoubleBits;
  const double depth_error =
      result.exact_rays && exact_normals ? ContourBounds::kDepthOfExact : ContourBounds::kDepth;
  for (PlaneId id = 0; id < geometry.planes.size(); ++id) {
    const auto& plane = space.depth_plane(id);
    result.depths[id] = plane.n;
    result.depth_error[id] = depth_error * plane.magnitude;
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_LIGHT_RAYS_H
