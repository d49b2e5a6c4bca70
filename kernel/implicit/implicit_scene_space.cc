// SPDX-License-Identifier: LGPL-3.0-or-later
// The decisions of kernel `plane` in space: the three kinds of vertices down the ladder of stages.
#include "kernel/implicit/implicit_scene_space.h"

#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/exact_predicates.h"
#include "kernel/implicit/plane_provenance.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

template <class Stats>
Side ImplicitSceneSpace<Stats>::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
  const FilteredPlane& plane = filtered(ref.index());
  const double bound = plane.usable ? SceneBounds::value(corner.vertex.error) : kUnknownError;
  return stages_.filtered(plane.value(corner.vertex.x), bound, ref.flipped(), [&] {
    if (is_known_on(ref, corner)) return stages_.known_on();
    const Sign sign = exact_side(ref.index(), corner);
    return side_of(ref.flipped() ? -sign : sign);
  });
}

template <class Stats>
bool ImplicitSceneSpace<Stats>::is_known_on(PlaneRef ref, const Corner<Vertex>& corner) const {
  // Identities (1) and (2); an input edge's number is no plane's.
  if (is_edge_of(ref, corner) || ref.index() == corner.support) return true;
  // Identity (3).
  return corner.vertex.source != kMadeVertex &&
         is_made_from(geometry().planes[ref.index()], corner.vertex.source);
}

// The widths are those of the precision plan, by kind of vertex.
template <class Stats>
Sign ImplicitSceneSpace<Stats>::exact_side(PlaneId plane, const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) {
    return stages_.exact(
        narrowest_width(side_of_support_bits(grid_bits())), 0, [&]<class, class Int>() {
          return sign_of(ExactGeometry<Int>(geometry()).value(plane, corner.vertex.source));
        });
  }
  const SceneEdges names = edges();
  if (names.is_input_edge(corner.before)) {
    return exact_side_of_edge_point(plane, names.edge(corner.before), corner.after.index());
  }
  if (names.is_input_edge(corner.after)) {
    return exact_side_of_edge_point(plane, names.edge(corner.after), corner.before.index());
  }
  return exact_side_of_plane_point(plane,
                                   {corner.support, corner.before.index(), corner.after.index()});
}

template <class Stats>
Sign ImplicitSceneSpace<Stats>::exact_side_of_edge_point(PlaneId plane, EdgeId edge, PlaneId cut) {
  const auto [u, v] = geometry().edges[edge];
  return stages_.exact(
      narrowest_width(edge_against_plane_bits(grid_bits())), support_value_bits(grid_bits()),
      [&, u = u, v = v]<class Value, class Int>() {
        const ExactGeometry<Value> exact(geometry());
        return sign_at_edge_point<Int>(exact.value(cut, u), exact.value(cut, v),
                                       exact.value(plane, u), exact.value(plane, v));
      });
}

// Seen from a vertex of the first plane, whose value is zero there.
template <class Stats>
Sign ImplicitSceneSpace<Stats>::exact_side_of_plane_point(PlaneId plane,
                                                          const std::array<PlaneId, 3>& meeting) {
  const VertexId from = geometry().planes[meeting[0]].a;
  return stages_.exact(narrowest_width(four_planes_bits(grid_bits())),
                       support_normal_bits(grid_bits()), [&]<class Factor, class Int>() {
                         using Value = Product<Int, Factor, Factor>;
                         const ExactGeometry<Factor> exact(geometry());
                         const Vector3<Factor> o = exact.position(from);
                         const auto value = [&](PlaneId id, const Vector3<Factor>& n) {
                           return dot<Value>(
                               n, difference(o, exact.position(geometry().planes[id].a)));
                         };
                         std::array<Vector3<Factor>, 3> n;
                         std::array<Value, 3> values{};
                         for (std::size_t i = 0; i < 3; ++i) {
                           n[i] = exact.template normal<Factor>(meeting[i]);
                           if (i > 0) values[i] = value(meeting[i], n[i]);
                         }
                         const Vector3<Factor> t = exact.template normal<Factor>(plane);
                         return sign_at_meet<Int>(n, values, t, value(plane, t));
                       });
}

template class ImplicitSceneSpace<NoStats>;
template class ImplicitSceneSpace<CountStats>;
}  // namespace gnomon
