// SPDX-License-Identifier: LGPL-3.0-or-later
// Planes through corners, in 128 bits where they hold them, else in GMP's integers.
#include "kernel/implicit/volume_construction.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "kernel/implicit/scaled_doubles.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {
namespace {

bool is_made(const Corner<VolumePoints::Vertex>& corner) {
  return corner.vertex.source == kMadeVertex;
}
/// With points X / w and w > 0: a positive multiple of the way from p to q.
template <class Point>
Vector3<mpz_class> way(const Point& p, const Point& q) {
  Vector3<mpz_class> result;
  for (int k = 0; k < 3; ++k) result[k] = p.w * q.x[k] - q.w * p.x[k];
  return result;
}

}  // namespace

PlaneRef VolumeConstruction::add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b,
                                       const Corner<Vertex>& c) {
  const std::array<const Corner<Vertex>*, 3> corners = {&a, &b, &c};
  int made = 0, last_made = 0, last_input = 0;
  for (int i = 0; i < 3; ++i) {
    if (is_made(*corners[i])) {
      ++made;
      last_made = i;
    } else {
      last_input = i;
    }
  }
  if (made == 0) return add_through({a.vertex.source, b.vertex.source, c.vertex.source});
  std::optional<PlaneRef> added;
  if (is_narrow() && made == 1) {
    added = add_through_made(corners[(last_made + 1) % 3]->vertex.source,
                             corners[(last_made + 2) % 3]->vertex.source, *corners[last_made]);
  } else if (is_narrow() && made == 2) {
    added = add_through_edge(*corners[last_input], *corners[(last_input + 1) % 3],
                             *corners[(last_input + 2) % 3]);
  }
  if (added) return *added;
  const Homogeneous<mpz_class> p = homogeneous(a), q = homogeneous(b), r = homogeneous(c);
  return add_spanned(p, way(p, q), way(p, r));
}

PlaneRef VolumeConstruction::add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b,
                                       const LightPoint& light) {
  if (is_narrow() && light.directional && !is_made(a) && !is_made(b)) {
    const std::optional<PlaneRef> added = add_along(a.vertex.source, b.vertex.source, light);
    if (added) return *added;
  }
  const Homogeneous<mpz_class> p = homogeneous(a), q = homogeneous(b);
  if (light.directional) return add_spanned(p, way(p, q), light.grid);
  return add_spanned(p, way(p, q), way(p, Homogeneous<mpz_class>{light.grid, 1}));
}

// Through the point X / w and along u and v: n = u x v, and d = n . X / w.
PlaneRef VolumeConstruction::add_spanned(const Homogeneous<mpz_class>& point,
                                         const Vector3<mpz_class>& u, const Vector3<mpz_class>& v) {
  ExactPlane<mpz_class> plane{cross(u, v), {}};
  plane.d = dot(plane.n, point.x);
  for (mpz_class& x : plane.n) x *= point.w;
  return add_explicit(std::move(plane));
}

// If 128 bits hold it.
std::optional<PlaneRef> VolumeConstruction::add_along(VertexId p, VertexId q,
                                                      const LightPoint& light) {
  const unsigned bits = bits_of(light.grid);
  if (bits > 62 || bits + 2 * grid_bits() + 4 > kNarrowBits) return std::nullopt;
  const Vector3<std::int64_t> origin = position_of<std::int64_t>(p),
                              direction = {light.grid[0].get_si(), light.grid[1].get_si(),
                                           light.grid[2].get_si()};
  ExactPlane<Int128> plane{
      cross<Int128>(difference(position_of<std::int64_t>(q), origin), direction), {}};
  plane.d = dot<Int128>(plane.n, origin);
  return add_narrow(plane);
}

// Through two input vertices and a made corner, if 128 bits hold it. A made corner on an input edge
// that starts at one of the vertices lies on the way to the other end. Otherwise, with the corner
// X / w: (q - p) x (X - w p).
std::optional<PlaneRef> VolumeConstruction::add_through_made(VertexId p, VertexId q,
                                                             const Corner<Vertex>& made) {
  for (const PlaneRef ref : {made.before, made.after}) {
    if (!is_input_edge(ref)) continue;
    const EdgeEnds ends = ends_of(ref);
    for (const auto [near, far] : {std::array{ends.a, ends.b}, std::array{ends.b, ends.a}}) {
      if (near == p || near == q) return add_through({p, q, far});
    }
  }
  const unsigned b = grid_bits();
  const PointMemo& memo = made_point(made);
  if (memo.bits + b + 2 > kNarrowBits) return std::nullopt;
  const Vector3<std::int64_t> origin = position_of<std::int64_t>(p),
                              u = difference(position_of<std::int64_t>(q), origin);
  Vector3<Int128> v;
  for (int k = 0; k < 3; ++k) v[k] = memo.narrow.x[k] - memo.narrow.w * origin[k];
  // n below 2^(b + 1) times v, and n . p below 3 2^b times that.
  if (bits_of(v) + 2 * b + 4 > kNarrowBits) return std::nullopt;
  ExactPlane<Int128> plane{cross<Int128>(u, v), {}};
  plane.d = dot<Int128>(plane.n, origin);
  return add_narrow(plane);
}

// Through v and the line in which planes A and B meet, if 128 bits hold it: A(v) B - B(v) A, or its
// opposite.
std::optional<PlaneRef> VolumeConstruction::add_through_line(VertexId v, const Plane& first,
                                                             const Plane& second) {
  if (first.is_explicit() || second.is_explicit() ||
      volume_value_bits(cut_once_normal_bits(grid_bits()), grid_bits()) > kNarrowBits) {
    return std::nullopt;
  }
  const Vector3<Int128> m = exact_normal<Int128>(first), n = exact_normal<Int128>(second);
  const Int128 at_first = exact_value<Int128>(first, m, v),
               at_second = exact_value<Int128>(second, n, v);
  ExactPlane<Int128> plane;
  for (int k = 0; k < 3; ++k) plane.n[k] = at_first * n[k] - at_second * m[k];
  plane.d = dot<Int128>(plane.n, position_of<std::int64_t>(v));
  return add_narrow(plane);
}

// Through an input vertex and two made corners of one edge, if 128 bits hold it. The edge is an
// input edge, or the line in which two planes meet. Which of the two orientations it has, doubles
// tell.
std::optional<PlaneRef> VolumeConstruction::add_through_edge(const Corner<Vertex>& p,
                                                             const Corner<Vertex>& q,
                                                             const Corner<Vertex>& r) {
  PlaneRef edge;
  for (const PlaneRef ref : {q.before, q.after}) {
    if (ref.same_plane(r.before) || ref.same_plane(r.after)) edge = ref;
  }
  if (!edge.valid() || q.support != r.support) return std::nullopt;
  const VertexId v = p.vertex.source;
  std::optional<PlaneRef> added;
  if (is_input_edge(edge)) {
    const EdgeEnds ends = ends_of(edge);
    added = add_through({v, ends.a, ends.b});
  } else {
    added = add_through_line(v, plane_at(q.support), plane_at(edge.index()));
  }
  if (!added || !added->valid()) return added;
  Double3 to_q, to_r;
  for (int k = 0; k < 3; ++k) {
    to_q[k] = q.vertex.x[k] - p.vertex.x[k];
    to_r[k] = r.vertex.x[k] - p.vertex.x[k];
  }
  const double turn = dot(plane_at(added->index()).n, cross(to_q, to_r));
  const double error = error_of(p.vertex) + error_of(q.vertex) + error_of(r.vertex);
  if (std::fabs(turn) > VolumeBounds::turn(error)) return turn > 0 ? *added : -*added;
  release_planes(plane_mark() - 1);
  return std::nullopt;
}

// value 2^b = m 2^e with an integer m below 2^53.
PlaneRef VolumeConstruction::add_axis_plane(int axis, double value) {
  assert(value >= 0 && value <= 1);
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent += static_cast<int>(grid_bits()) - 53;
  const auto k = static_cast<std::size_t>(axis);
  if (is_fixed() && exponent > -static_cast<int>(kNarrowBits)) {
    ExactPlane<Int128> plane{};
    plane.n[k] = Int128{1} << std::max(0, -exponent);
    plane.d = Int128{mantissa} << std::max(0, exponent);
    return add_narrow(plane);
  }
  ExactPlane<mpz_class> plane;
  plane.n[k] = mpz_class(1) << static_cast<unsigned>(std::max(0, -exponent));
  plane.d = integer_from<mpz_class>(mantissa) << static_cast<unsigned>(std::max(0, exponent));
  return add_explicit(std::move(plane));
}

}  // namespace gnomon
