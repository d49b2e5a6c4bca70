// SPDX-License-Identifier: LGPL-3.0-or-later
// The points of corners of volume space: in doubles with a bound for the filter, and exactly, from
// the planes that meet in them.
//
// A vertex is never constructed: it is an input vertex, or the point where the planes that its
// corner names meet. A made vertex whose doubles would be poor (planes that meet at a small angle)
// has them computed from the integers once, when it is made.
//
// Guarantee: every bound is proven (VolumeBounds). Reference: docs/exactness.md, "Shadow volumes".
#ifndef GNOMON_KERNEL_IMPLICIT_VOLUME_POINTS_H
#define GNOMON_KERNEL_IMPLICIT_VOLUME_POINTS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/implicit/volume_planes.h"

namespace gnomon {

class VolumePoints : public VolumePlanes {
 public:
  /// Doubles in grid units times 2^-b, so that every coordinate of the scene is in [0, 1].
  struct Vertex {
    std::array<double, 3> x{};
    /// Bound of the error of n . x - d in doubles, for every plane: VolumeBounds::vertex().
    /// Infinite: the doubles say nothing.
    float bound = 0;
    VertexId source = kMadeVertex;
  };

  Vertex input_vertex(VertexId v) const {
    Vertex vertex;
    vertex.x = input_point(v);
    vertex.bound = rounded_up(VolumeBounds::vertex(VolumeBounds::input(grid_bits()), 1));
    vertex.source = v;
    return vertex;
  }
  /// The made vertex where three planes of axes meet. Requires: values in [0, 1].
  Vertex axis_point(const std::array<double, 3>& values) const {
    Vertex vertex;
    vertex.x = values;
    vertex.bound = rounded_up(VolumeBounds::vertex(0, 1));
    return vertex;
  }
  /// Where the edge `edge` of the loop meets `plane`, which has the edge's ends strictly on
  /// different sides. Only the doubles are computed; the vertex is the corner that the caller puts
  /// it in.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;

 protected:
  using VolumePlanes::VolumePlanes;

  /// A point as vertex `origin` + x / w, in grid units.
  template <class Int>
  struct ExactPoint {
    VertexId origin = 0;
    Vector3<Int> x{};
    Int w{};
  };
  /// Homogeneous coordinates, w > 0, no common divisor.
  template <class Int>
  struct Homogeneous {
    Vector3<Int> x{};
    Int w{};
  };
  /// Made corners of lights that planes were put through lately.
  struct PointMemo {
    std::array<std::uint32_t, 3> key{kMadeVertex, kMadeVertex, kMadeVertex};
    Homogeneous<mpz_class> point;
    Homogeneous<Int128> narrow;  // the same, if `bits` is at most kNarrowBits
    unsigned bits = 0;           // of the largest coordinate
  };
  /// For a made corner: the planes that meet there, and a vertex to see the point from.
  struct Meet {
    std::array<const Plane*, 3> planes;
    VertexId pivot = 0;
  };
  /// For a made corner on an input edge: the edge, and the plane that meets it.
  struct EdgePoint {
    EdgeEnds ends;
    const Plane* cut;
  };

  /// Of a coordinate of a made vertex.
  static double error_of(const Vertex& vertex) {
    return VolumeBounds::coordinate(static_cast<double>(vertex.bound));
  }
  /// Whether a made corner is on an input edge, an edge_point(), or else where three planes meet.
  bool is_on_input_edge(const Corner<Vertex>& corner) const {
    return is_input_edge(corner.before) || is_input_edge(corner.after);
  }
  EdgePoint edge_point(const Corner<Vertex>& corner) const {
    const bool before_is_edge = is_input_edge(corner.before);
    return {ends_of(before_is_edge ? corner.before : corner.after),
            &plane_at((before_is_edge ? corner.after : corner.before).index())};
  }
  Meet meet_of(const Corner<Vertex>& corner) const {
    return {{&plane_at(corner.support), &plane_at(corner.before.index()),
             &plane_at(corner.after.index())}};
  }
  /// Calls f(ExactPoint<Int>) with integers that hold a made corner's point, seen from `pivot` if
  /// it is where three planes meet.
  template <class F>
  void with_exact_point(const Corner<Vertex>& corner, bool unbounded, VertexId pivot,
                        const F& f) const;
  /// A vertex that defines one of a made corner's planes, or any.
  VertexId some_pivot(const Corner<Vertex>& corner) const;
  Homogeneous<mpz_class> homogeneous(const Corner<Vertex>& corner);
  /// Valid until the next call.
  const PointMemo& made_point(const Corner<Vertex>& corner);

 private:
  static constexpr std::size_t kPointMemos = 64;

  template <class Factor, class Int>
  ExactPoint<Int> exact_edge_point(const EdgePoint& point) const;
  template <class Factor, class Int>
  ExactPoint<Int> exact_meet(const Meet& meet) const;
  double cross_edge(const Plane& plane, EdgeEnds edge, Vertex& vertex) const;
  double cross_line(const Plane& plane, const Plane& edge, const Corner<Vertex>& from,
                    Vertex& vertex) const;
  Vertex repaired(const Corner<Vertex>& corner) const;

  std::vector<PointMemo> points_;
};

// The point u + P(u) (v - u) / (P(u) - P(v)).
template <class Factor, class Int>
VolumePoints::ExactPoint<Int> VolumePoints::exact_edge_point(const EdgePoint& at) const {
  const EdgeEnds ends = at.ends;
  const Vector3<Factor> p = exact_normal<Factor>(*at.cut);
  const Int at_u = exact_value<Int>(*at.cut, p, ends.a),
            at_v = exact_value<Int>(*at.cut, p, ends.b);
  ExactPoint<Int> point;
  point.origin = ends.a;
  point.w = at_u - at_v;
  with_position<Factor>([&]<class Position>() {
    const Vector3<Position> step =
        difference(position_of<Position>(ends.b), position_of<Position>(ends.a));
    for (int k = 0; k < 3; ++k) point.x[k] = multiply<Int>(at_u, step[k]);
  });
  return point;
}

// The point o - (P(o) q x r + Q(o) r x p + R(o) p x q) / (p . q x r).
template <class Factor, class Int>
VolumePoints::ExactPoint<Int> VolumePoints::exact_meet(const Meet& meet) const {
  using Value = Product<Int, Factor, Factor>;
  using Cross = Product<Int, Factor, Factor>;
  const std::array<Vector3<Factor>, 3> n = {exact_normal<Factor>(*meet.planes[0]),
                                            exact_normal<Factor>(*meet.planes[1]),
                                            exact_normal<Factor>(*meet.planes[2])};
  ExactPoint<Int> point;
  point.origin = meet.pivot;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3<Cross> minors = cross<Cross>(n[(i + 1) % 3], n[(i + 2) % 3]);
    const Value value = exact_value<Value>(*meet.planes[i], n[i], meet.pivot);
    for (std::size_t k = 0; k < 3; ++k) {
      point.x[k] = Int(point.x[k] - multiply<Int>(value, minors[k]));
    }
    if (i == 0) point.w = dot<Int>(n[0], minors);
  }
  return point;
}

template <class F>
void VolumePoints::with_exact_point(const Corner<Vertex>& corner, bool unbounded, VertexId pivot,
                                    const F& f) const {
  const bool fixed = is_fixed() && !unbounded;
  if (is_on_input_edge(corner)) {
    const EdgePoint point = edge_point(corner);
    with_widths(width_of(fixed, value_bits(*point.cut) + grid_bits() + 1),
                std::max(normal_bits(*point.cut), grid_bits()),
                [&]<class Factor, class Int>() { f(exact_edge_point<Factor, Int>(point)); });
    return;
  }
  Meet meet = meet_of(corner);
  meet.pivot = pivot;
  Widths widths;
  for (const Plane* plane : meet.planes) count_widths(*plane, widths);
  // A value and a cross product of two: three terms of two products. The determinant has less.
  const unsigned bits = widths.normals + std::max(widths.rest, 1u) + 1 + 2 + 1;
  with_widths(width_of(fixed, bits), std::max(widths.largest_normal, grid_bits()),
              [&]<class Factor, class Int>() { f(exact_meet<Factor, Int>(meet)); });
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_VOLUME_POINTS_H
