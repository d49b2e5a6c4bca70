// SPDX-License-Identifier: LGPL-3.0-or-later
// Doubles of the vertices that cuts make, from doubles where their bound allows, or from integers.
#include "kernel/implicit/volume_points.h"

#include <algorithm>
#include <cmath>

#include "kernel/implicit/scaled_doubles.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

VertexId VolumePoints::some_pivot(const Corner<Vertex>& corner) const {
  for (const PlaneRef ref : {PlaneRef(corner.support), corner.before, corner.after}) {
    if (is_input_edge(ref)) continue;
    const Plane& plane = plane_at(ref.index());
    if (!plane.is_explicit()) return plane.source.vertices[0];
  }
  return 0;
}

// --- Homogeneous points. ---

VolumePoints::Homogeneous<mpz_class> VolumePoints::homogeneous(const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) {
    return {position_of<mpz_class>(corner.vertex.source), 1};
  }
  return made_point(corner).point;
}

const VolumePoints::PointMemo& VolumePoints::made_point(const Corner<Vertex>& corner) {
  const std::array<std::uint32_t, 3> key = {corner.support, corner.before.index(),
                                            corner.after.index()};
  if (points_.empty()) points_.resize(kPointMemos);
  PointMemo& memo = points_[(key[0] * 31u + key[1] * 7u + key[2]) % kPointMemos];
  if (memo.key == key) return memo;
  Homogeneous<mpz_class>& point = memo.point;
  with_exact_point(corner, true, some_pivot(corner), [&]<class Int>(const ExactPoint<Int>& exact) {
    if constexpr (std::is_same_v<Int, mpz_class>) {
      const Vector3<mpz_class> origin = position_of<mpz_class>(exact.origin);
      point.w = exact.w;
      for (int k = 0; k < 3; ++k) point.x[k] = origin[k] * exact.w + exact.x[k];
    }
  });
  mpz_class divisor = point.w;
  for (const mpz_class& x : point.x) divisor = gcd(divisor, x);
  if (sgn(point.w) < 0) divisor = -divisor;
  for (mpz_class& x : point.x) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
  mpz_divexact(point.w.get_mpz_t(), point.w.get_mpz_t(), divisor.get_mpz_t());
  memo.bits = std::max(bits_of(point.x), bits_of(point.w));
  if (memo.bits <= kNarrowBits) {
    for (int k = 0; k < 3; ++k) memo.narrow.x[k] = integer_from<Int128>(point.x[k]);
    memo.narrow.w = integer_from<Int128>(point.w);
  }
  // Planes added here may go, and their numbers with them.
  memo.key = key;
  if (std::max({key[0], key[1], key[2]}) >= first_own()) memo.key[0] = kMadeVertex;
  return memo;
}

// --- Vertices that cuts make. ---

// Computed from the ends of the input edge, so that the bound does not grow with the number of
// cuts. Returns the error of the vertex, which it sets.
double VolumePoints::cross_edge(const Plane& plane, EdgeEnds edge, Vertex& vertex) const {
  const Double3 u = input_point(edge.a), v = input_point(edge.b);
  const double f = plane.value(u), g = plane.value(v), gap = std::fabs(f - g);
  const double value_error = VolumeBounds::vertex(2 * VolumeBounds::kUnit, 1);
  if (!(gap > VolumeBounds::kLeastGap * value_error)) return kUnknownError;
  const double parameter = f / (f - g);
  double span = 0;
  for (int k = 0; k < 3; ++k) {
    const double step = v[k] - u[k];
    vertex.x[k] = u[k] + parameter * step;
    span = std::max(span, std::fabs(step));
  }
  return VolumeBounds::edge_point(value_error, gap, span);
}

// From any point x: with the residuals r_i of the planes there, the point where they meet is
// x + (r_0 n_1 x n_2 + r_1 n_2 x n_0 + r_2 n_0 x n_1) / (n_0 . n_1 x n_2). It does not matter how x
// was found: nothing adds up from cut to cut.
double VolumePoints::cross_line(const Plane& t, const Plane& e, const Corner<Vertex>& from,
                                Vertex& vertex) const {
  const Plane& s = plane_at(from.support);
  const Double3& x = from.vertex.x;
  const Double3 st = cross(s.n, t.n), et = cross(e.n, t.n), se = cross(s.n, e.n);
  const double det = dot(se, t.n), size = std::fabs(det);
  const double at_s = s.d - dot(s.n, x), at_e = dot(e.n, x) - e.d, at_t = t.d - dot(t.n, x);
  const double inverse = 1 / det;
  double most = 0, moved = 0;
  for (int k = 0; k < 3; ++k) {
    const double step = (at_s * et[k] + at_e * st[k] + at_t * se[k]) * inverse;
    vertex.x[k] = x[k] + step;
    most = std::max(most, std::fabs(et[k]) + std::fabs(st[k]) + std::fabs(se[k]));
    moved = std::max(moved, std::fabs(step));
  }
  const double magnitude = std::max(1.0, largest(x));
  const double residuals = std::fabs(at_s) + std::fabs(at_e) + std::fabs(at_t);
  if (!(size > VolumeBounds::kLeastMeet)) return kUnknownError;
  return VolumeBounds::meet(magnitude, most, residuals, moved, size);
}

VolumePoints::Vertex VolumePoints::crossing(PlaneRef ref, PlaneRef edge, bool,
                                            const Corner<Vertex>& from,
                                            const Corner<Vertex>&) const {
  const Plane& plane = plane_at(ref.index());
  Vertex vertex;
  const double error = is_input_edge(edge)
                           ? cross_edge(plane, ends_of(edge), vertex)
                           : cross_line(plane, plane_at(edge.index()), from, vertex);
  if (error < VolumeBounds::kWorstError) {
    const double magnitude = std::max(1.0, 1.01 * largest(vertex.x));
    vertex.bound = rounded_up(VolumeBounds::vertex(error, magnitude));
    return vertex;
  }
  return repaired(Corner<Vertex>{edge, vertex, ref, from.support});
}

// Doubles from the integers.
VolumePoints::Vertex VolumePoints::repaired(const Corner<Vertex>& corner) const {
  Vertex vertex;
  with_exact_point(corner, false, some_pivot(corner), [&]<class Int>(const ExactPoint<Int>& point) {
    vertex.x = input_point(point.origin);
    const long shift = excess_bits(point.w);
    const double w = to_double_scaled(point.w, shift);
    for (int k = 0; k < 3; ++k) {
      vertex.x[k] += to_double_scaled(point.x[k], shift + grid_bits()) / w;
    }
  });
  vertex.bound = rounded_up(VolumeBounds::repaired(std::max(1.0, largest(vertex.x))));
  return vertex;
}

}  // namespace gnomon
