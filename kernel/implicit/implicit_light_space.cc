// SPDX-License-Identifier: LGPL-3.0-or-later
// The decisions of kernel `plane` in light space that its filter leaves open: identities, and
// integers made from what the planes came from.
#include "kernel/implicit/implicit_light_space.h"

#include <algorithm>

#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/exact_shadow_plane.h"
#include "kernel/implicit/plane_provenance.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

// --- Planes through the light. ---

template <class Stats>
Side ImplicitLightSpace<Stats>::undecided_side(PlaneRef ref, const Corner<Vertex>& corner) {
  if (is_edge_of(ref, corner)) return stages_.known_on();  // identity (1)
  const VertexId input = corner.vertex.source;
  if (input != kMadeVertex && is_edge(ref) && is_made_from(ends_of(ref), input)) {
    return stages_.known_on();  // identity (3)
  }
  const PlaneRef plane(ref.index());
  const Sign sign = input != kMadeVertex ? exact_side_of_input(plane, input)
                                         : exact_side_of_crossing(plane, corner);
  return side_of(ref.flipped() ? -sign : sign);
}

// det(q_a, q_b, q_c) for the plane of an edge, n . q for any other.
template <class Stats>
Sign ImplicitLightSpace<Stats>::exact_side_of_input(PlaneRef plane, VertexId vertex) {
  const LightIntegers& light = integers();
  if (is_edge(plane)) {
    const EdgeEnds ends = ends_of(plane);
    return stages_.exact(width_of(light.narrow, light.side_bits), 0, [&]<class, class Int>() {
      using Position = PositionFor<Int>;
      const ExactGeometry<Position> exact(geometry());
      const Vector3<Position> a = exact.position(ends.a);
      Vector3<Position> l = light.position<Position>();
      if (light.far) l = difference(l, a);  // then the side is as of a sun
      return side_of_shadow_plane<Int>(light.is_parallel(), l, a, exact.position(ends.b),
                                       exact.position(vertex));
    });
  }
  const unsigned bits = plane_bits(plane);
  return stages_.exact(
      width_of(light.narrow && is_narrow(plane), side_of_input_vertex_bits(bits, light.q_bits)),
      std::max(bits, light.q_bits), [&]<class Factor, class Int>() {
        return sign_of(dot<Int>(exact_normal<Factor>(plane), light.q<Factor>(vertex)));
      });
}

// n . (n_before x n_after).
template <class Stats>
Sign ImplicitLightSpace<Stats>::exact_side_of_crossing(PlaneRef plane,
                                                       const Corner<Vertex>& corner) {
  const bool narrow =
      integers().narrow && is_narrow(plane) && is_narrow(corner.before) && is_narrow(corner.after);
  const unsigned n = plane_bits(plane), m = plane_bits(corner.before), l = plane_bits(corner.after);
  return stages_.exact(width_of(narrow, side_of_crossing_bits(n, m, l)), std::max({n, m, l}),
                       [&]<class Factor, class Int>() {
                         return sign_of_determinant<Int>(exact_normal<Factor>(plane),
                                                         exact_normal<Factor>(corner.before),
                                                         exact_normal<Factor>(corner.after));
                       });
}

// --- Depths. ---

template <class Stats>
Side ImplicitLightSpace<Stats>::side_of_support(PlaneId plane, const Corner<Vertex>& corner) {
  if (plane == corner.support) return stages_.known_on();  // identity (2)
  const DepthPlane& own = depth(corner.support);
  const DepthPlane& other = depth(plane);
  const std::array<double, 3>& r = corner.vertex.ray;
  const double value = (own.n[0] - other.n[0]) * r[0] + (own.n[1] - other.n[1]) * r[1] +
                       (own.n[2] - other.n[2]) * r[2];
  const double bound = LightBounds::depth_difference(own.magnitude + other.magnitude,
                                                     static_cast<double>(corner.vertex.bound));
  // What is nearer is in front of a plane that faces the light.
  return stages_.filtered(value, bound, other.at_light != Sign::kPositive,
                          [&] { return undecided_depth(plane, corner); });
}

template <class Stats>
Side ImplicitLightSpace<Stats>::undecided_depth(PlaneId plane, const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) return side_of(input_depth(plane, corner.vertex.source));
  if (is_cut_of(corner.before, corner.support, plane) ||
      is_cut_of(corner.after, corner.support, plane)) {
    return stages_.known_on();  // identity (5)
  }
  // A vertex on an edge of its own polygon lies between the edge's ends: a few decisions of degree
  // 3 often save one of degree 9. A polygon that shares the edge is the common case.
  for (const bool first : {true, false}) {
    const PlaneRef ref = first ? corner.before : corner.after;
    if (!is_edge(ref)) continue;
    const EdgeEnds ends = ends_of(ref);
    if (input_depth(corner.support, ends.a) != Sign::kZero ||
        input_depth(corner.support, ends.b) != Sign::kZero) {
      continue;  // an edge of another plane
    }
    const Sign a = input_depth(plane, ends.a), b = input_depth(plane, ends.b);
    if (a == -b && a != Sign::kZero) continue;
    if (!is_between(ends, first ? corner.after : corner.before)) continue;  // of another polygon
    return side_of(a == Sign::kZero ? b : a);
  }
  return side_of(exact_depth_of_crossing(plane, corner));
}

// Polygons of one plane may be cut by each other's edges, where these end, and beyond.
template <class Stats>
bool ImplicitLightSpace<Stats>::is_between(const EdgeEnds& ends, PlaneRef cut) {
  const auto side = [&](VertexId vertex) {
    return is_edge(cut) && is_made_from(ends_of(cut), vertex)
               ? stages_.known(Sign::kZero)
               : exact_side_of_input(PlaneRef(cut.index()), vertex);
  };
  const Sign a = side(ends.a);
  return a != Sign::kZero && a == -side(ends.b);
}

// The cut of the two support planes against the crossing's ray.
template <class Stats>
Sign ImplicitLightSpace<Stats>::exact_depth_of_crossing(PlaneId plane,
                                                        const Corner<Vertex>& corner) {
  const LightIntegers& light = integers();
  const bool narrow = light.narrow && is_narrow(corner.before) && is_narrow(corner.after);
  const unsigned n = light.cut_bits, m = plane_bits(corner.before), l = plane_bits(corner.after);
  return stages_.exact(width_of(narrow, side_of_crossing_bits(n, m, l)), std::max({n, m, l}),
                       [&]<class Factor, class Int>() {
                         return sign_of_determinant<Int>(
                             light.cut_of_supports<Factor>(corner.support, plane),
                             exact_normal<Factor>(corner.before),
                             exact_normal<Factor>(corner.after));
                       });
}

template <class Stats>
Sign ImplicitLightSpace<Stats>::input_depth(PlaneId plane, VertexId vertex) {
  if (is_made_from(geometry().planes[plane], vertex)) {
    return stages_.known(Sign::kZero);  // identity (3)
  }
  const std::uint64_t key = (std::uint64_t{plane} << 32 | vertex) + 1;
  DepthMemo& memo = depth_memo_[(plane * 0x9e3779b9u ^ vertex * 0x85ebca6bu) >> 22];
  if (memo.key == key) return stages_.known(memo.sign);
  const unsigned b = geometry().grid.bits();
  const Sign sign =
      stages_.exact(narrowest_width(side_of_support_bits(b)), b, [&]<class, class Int>() {
        return sign_of(ExactGeometry<Int>(geometry()).value(plane, vertex));
      });
  memo = {key, sign};
  return sign;
}

template class ImplicitLightSpace<NoStats>;
template class ImplicitLightSpace<CountStats>;

}  // namespace gnomon
