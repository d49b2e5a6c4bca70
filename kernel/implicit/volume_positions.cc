// SPDX-License-Identifier: LGPL-3.0-or-later
// Positions of corners of volume space, from doubles, integers, pairs of doubles and rationals.
#include "kernel/implicit/volume_positions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "kernel/implicit/scaled_doubles.h"
#include "kernel/signs/fp_environment.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {

std::array<Ball, 3> VolumePositions::position(const Corner<Vertex>& corner) const {
  const Vertex& vertex = corner.vertex;
  std::array<Ball, 3> point;
  if (vertex.source != kMadeVertex) {
    const double error = VolumeBounds::input(grid_bits());
    for (int k = 0; k < 3; ++k) {
      point[k] = Ball(vertex.x[k], error * vertex.x[k] + (error == 0 ? 0 : Ball::kTiny));
    }
    return point;
  }
  const double error = error_of(vertex);
  for (int k = 0; k < 3; ++k) point[k] = Ball(vertex.x[k], error);
  return point;
}

// --- As seen from a vertex. ---

std::array<Ball, 3> VolumePositions::input_offset(VertexId from, VertexId to) const {
  std::array<Ball, 3> result;
  if (from == to) return result;
  const auto by = [&]<class Position>() {
    const Vector3<Position> step =
        difference(position_of<Position>(to), position_of<Position>(from));
    for (int k = 0; k < 3; ++k) {
      constexpr bool kIsWide = std::is_same_v<Position, mpz_class>;
      double x;
      if constexpr (kIsWide) {
        x = to_double_scaled(step[k], grid_bits());
      } else {
        x = to_double(step[k]) * grid_scale();
      }
      // One conversion; only wide integers may underflow.
      result[k] = Ball(x, 2 * Ball::kUnit * std::fabs(x) + (kIsWide ? Ball::kTiny : 0));
    }
  };
  if (is_narrow()) {
    by.template operator()<std::int64_t>();
  } else if (is_fixed()) {
    by.template operator()<Int128>();
  } else {
    by.template operator()<mpz_class>();
  }
  return result;
}

std::array<Ball, 3> VolumePositions::exact_offset(VertexId origin,
                                                  const Corner<Vertex>& corner) const {
  std::array<Ball, 3> result;
  with_exact_point(corner, false, origin, [&]<class Int>(const ExactPoint<Int>& point) {
    const long shift = excess_bits(point.w);
    const double w = to_double_scaled(point.w, shift);
    const std::array<Ball, 3> from = input_offset(origin, point.origin);
    for (int k = 0; k < 3; ++k) {
      const double step = to_double_scaled(point.x[k], shift + grid_bits()) / w;
      result[k] = from[k] + Ball(step, VolumeBounds::kQuotient * std::fabs(step) + Ball::kTiny);
    }
  });
  return result;
}

std::array<Ball, 3> VolumePositions::edge_offset(VertexId origin,
                                                 const Corner<Vertex>& corner) const {
  const EdgePoint at = edge_point(corner);
  const double at_a = accurate_value(*at.cut, at.ends.a), at_b = accurate_value(*at.cut, at.ends.b);
  // The parameter is as exact as the smaller value, which may have underflowed alone.
  if (!(std::min(std::fabs(at_a), std::fabs(at_b)) > 0x1p-900)) return exact_offset(origin, corner);
  const double t = at_a / (at_a - at_b);
  const Ball parameter(t, VolumeBounds::kParameter * std::fabs(t) + Ball::kTiny);
  const std::array<Ball, 3> from = input_offset(origin, at.ends.a),
                            step = input_offset(at.ends.a, at.ends.b);
  std::array<Ball, 3> result;
  for (int k = 0; k < 3; ++k) result[k] = from[k] + parameter * step[k];
  return result;
}

std::array<Ball, 3> VolumePositions::offset(VertexId origin, const Corner<Vertex>& corner) const {
  if (corner.vertex.source != kMadeVertex) return input_offset(origin, corner.vertex.source);
  if (is_on_input_edge(corner)) return edge_offset(origin, corner);
  const Meet meet = meet_of(corner);
  const Double3 &p = meet.planes[0]->n, &q = meet.planes[1]->n, &r = meet.planes[2]->n;
  const Double3 qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  const double det = dot(p, qr), size = std::fabs(det);
  if (!(size > VolumeBounds::kLeastDeterminant)) return exact_offset(origin, corner);
  Double3 v;
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = -accurate_value(*meet.planes[i], origin);
    sum += std::fabs(v[i]);
  }
  if (!(sum > 0x1p-800) && sum != 0) return exact_offset(origin, corner);
  const double inverse = 1 / det;
  std::array<Ball, 3> result;
  for (int k = 0; k < 3; ++k) {
    const double step = (v[0] * qr[k] + v[1] * rp[k] + v[2] * pq[k]) * inverse;
    result[k] = Ball(step, VolumeBounds::offset(sum, std::fabs(step), size));
  }
  return result;
}

// --- In the scene. ---

std::array<mpq_class, 3> VolumePositions::exact_position(const Corner<Vertex>& corner) const {
  const GridPositions& grid = geometry().grid;
  std::array<mpq_class, 3> result;
  if (corner.vertex.source != kMadeVertex) {
    for (int k = 0; k < 3; ++k) result[k] = grid.at(corner.vertex.source, k);
  } else {
    with_exact_point(corner, true, some_pivot(corner),
                     [&]<class Int>(const ExactPoint<Int>& point) {
                       if constexpr (std::is_same_v<Int, mpz_class>) {
                         for (int k = 0; k < 3; ++k) {
                           result[k] = mpq_class(point.x[k], point.w);
                           result[k].canonicalize();
                           result[k] += grid.at(point.origin, k);
                         }
                       }
                     });
  }
  for (int k = 0; k < 3; ++k) result[k] = geometry().origin[k] + geometry().step * result[k];
  return result;
}

bool VolumePositions::have_same_coordinate(int axis, VertexId a, VertexId b, VertexId c) const {
  if (is_narrow()) {
    const GridPositions& grid = geometry().grid;
    const std::int64_t x = grid.narrow(a, axis);
    return x == grid.narrow(b, axis) && x == grid.narrow(c, axis);
  }
  const Int128 x = position_of<Int128>(a)[axis];
  return x == position_of<Int128>(b)[axis] && x == position_of<Int128>(c)[axis];
}

// A coordinate that all points of one of the planes (or of the edge) have is that of an input
// vertex: much of a scene stands on z = 0, which no bound can tell.
VolumePositions::PartlyKnown VolumePositions::shared_coordinates(
    const Corner<Vertex>& corner) const {
  PartlyKnown point;
  if (!is_fixed()) return point;
  const auto same = [&](VertexId a, VertexId b, VertexId c) {
    for (int k = 0; k < 3; ++k) {
      if (!have_same_coordinate(k, a, b, c)) continue;
      point.x[k] = geometry().positions[a][k];
      point.known[k] = true;
    }
  };
  for (const PlaneRef ref : {PlaneRef(corner.support), corner.before, corner.after}) {
    if (is_input_edge(ref)) {
      const EdgeEnds ends = ends_of(ref);
      same(ends.a, ends.b, ends.b);
    } else if (const Plane& plane = plane_at(ref.index()); !plane.is_explicit()) {
      const std::array<std::uint32_t, 3>& v = plane.source.vertices;
      same(v[0], v[1], v[2]);
    }
  }
  return point;
}

// In pairs of doubles.
void VolumePositions::add_nearest(const Corner<Vertex>& corner, PartlyKnown& partly) const {
  const GridPositions& grid = geometry().grid;
  with_exact_point(corner, false, some_pivot(corner), [&]<class Int>(const ExactPoint<Int>& point) {
    const DoubleDouble w = double_double(point.w);
    for (int k = 0; k < 3; ++k) {
      if (partly.known[k]) continue;
      const DoubleDouble at = is_narrow() ? double_double(grid.narrow(point.origin, k))
                                          : double_double(grid.wide(point.origin, k));
      const DoubleDouble offset = double_double(point.x[k]) / w;
      const double most =
          std::fabs(origin(k).high) + (std::fabs(at.high) + std::fabs(offset.high)) * step().high;
      const std::optional<double> nearest =
          gnomon::nearest_double(origin(k) + (at + offset) * step(), kPairError * most);
      if (!nearest) continue;
      partly.x[k] = *nearest;
      partly.known[k] = true;
    }
  });
}

std::array<double, 3> VolumePositions::nearest_position(const Corner<Vertex>& corner) const {
  if (corner.vertex.source != kMadeVertex) return geometry().positions[corner.vertex.source];
  PartlyKnown point = shared_coordinates(corner);
  add_nearest(corner, point);
  if (point.known[0] && point.known[1] && point.known[2]) return point.x;
  const std::array<mpq_class, 3> exact = exact_position(corner);
  for (int k = 0; k < 3; ++k) {
    if (!point.known[k]) point.x[k] = gnomon::nearest_double(exact[k]);
  }
  return point.x;
}

}  // namespace gnomon
