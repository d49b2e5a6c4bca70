// SPDX-License-Identifier: LGPL-3.0-or-later
// The decisions of kernel `plane` about shadow volumes that its filter leaves open: identities, and
// integers made from what the planes came from.
#include "kernel/implicit/implicit_volume_space.h"

#include <algorithm>

#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/exact_predicates.h"
#include "kernel/implicit/plane_provenance.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

template <class Stats>
Side ImplicitVolumeSpace<Stats>::undecided_side(PlaneRef ref, const Corner<Vertex>& corner) {
  if (is_known_on(ref, corner)) return stages_.known_on();
  const Sign sign = exact_side(plane_at(ref.index()), corner);
  return side_of(ref.flipped() ? -sign : sign);
}

template <class Stats>
bool ImplicitVolumeSpace<Stats>::is_known_on(PlaneRef ref, const Corner<Vertex>& corner) const {
  if (is_edge_of(ref, corner) || ref.index() == corner.support) return true;  // (1), (2)
  const VolumePlaneSource& source = plane_at(ref.index()).source;
  if (source.is_explicit()) return false;
  if (corner.vertex.source != kMadeVertex) return source.has(corner.vertex.source);  // (3)
  const auto shared_with = [&](PlaneRef other) {
    return is_input_edge(other) ? source.shared_with(ends_of(other))
                                : source.shared_with(plane_at(other.index()).source);
  };
  return is_on_shared_line(shared_with(corner.before), is_input_edge(corner.before),
                           shared_with(corner.after), is_input_edge(corner.after),
                           shared_with(PlaneRef(corner.support)));  // (4)
}

template <class Stats>
Sign ImplicitVolumeSpace<Stats>::exact_side(const Plane& plane, const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) return exact_side_of_input(plane, corner.vertex.source);
  if (is_on_input_edge(corner)) return exact_side_of_edge_point(plane, edge_point(corner));
  Meet meet = meet_of(corner);
  meet.pivot = best_pivot(plane, meet);
  return exact_side_of_meet(plane, meet);
}

template <class Stats>
Sign ImplicitVolumeSpace<Stats>::exact_side_of_input(const Plane& plane, VertexId v) {
  return decide(normal_bits(plane), value_bits(plane) + 1, [&]<class Factor, class Int>() {
    return sign_of(exact_value<Int>(plane, exact_normal<Factor>(plane), v));
  });
}

template <class Stats>
Sign ImplicitVolumeSpace<Stats>::exact_side_of_edge_point(const Plane& plane,
                                                          const EdgePoint& point) {
  const Plane& cut = *point.cut;
  return decide(
      std::max(normal_bits(plane), normal_bits(cut)),
      volume_edge_bits(value_bits(plane), value_bits(cut)), [&]<class Factor, class Int>() {
        using Value = Product<Int, Factor, Factor>;
        const auto [u, v] = point.ends;
        const Vector3<Factor> p = exact_normal<Factor>(cut), q = exact_normal<Factor>(plane);
        return sign_at_edge_point<Int>(exact_value<Value>(cut, p, u), exact_value<Value>(cut, p, v),
                                       exact_value<Value>(plane, q, u),
                                       exact_value<Value>(plane, q, v));
      });
}

// The values at a vertex that defines many of the planes are zero.
template <class Stats>
VertexId ImplicitVolumeSpace<Stats>::best_pivot(const Plane& plane, const Meet& meet) {
  VertexId pivot = 0;
  int most = -1;
  const auto consider = [&](const Plane& candidate) {
    if (candidate.is_explicit()) return;
    for (const VertexId v : candidate.source.vertices) {
      int count = !plane.is_explicit() && plane.source.has(v) ? 1 : 0;
      for (const Plane* other : meet.planes) {
        count += !other->is_explicit() && other->source.has(v) ? 1 : 0;
      }
      if (count > most) {
        most = count;
        pivot = v;
      }
    }
  };
  consider(plane);
  consider(*meet.planes[1]);
  consider(*meet.planes[2]);
  if (most < 2) consider(*meet.planes[0]);
  return pivot;
}

template <class Stats>
Sign ImplicitVolumeSpace<Stats>::exact_side_of_meet(const Plane& plane, const Meet& meet) {
  Widths widths;
  count_widths(plane, widths);
  for (const Plane* other : meet.planes) count_widths(*other, widths);
  return decide(widths.largest_normal, volume_meet_bits(widths.normals + widths.rest),
                [&]<class Factor, class Int>() {
                  using Value = Product<Int, Factor, Factor>;
                  std::array<Vector3<Factor>, 3> n;
                  std::array<Value, 3> values;
                  for (std::size_t i = 0; i < 3; ++i) {
                    n[i] = exact_normal<Factor>(*meet.planes[i]);
                    values[i] = exact_value<Value>(*meet.planes[i], n[i], meet.pivot);
                  }
                  const Vector3<Factor> t = exact_normal<Factor>(plane);
                  return sign_at_meet<Int>(n, values, t, exact_value<Value>(plane, t, meet.pivot));
                });
}

template class ImplicitVolumeSpace<NoStats>;
template class ImplicitVolumeSpace<CountStats>;

}  // namespace gnomon
