// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `plane` in the light space of one point or directional light: on which side of a plane
// through the light is a vertex of a fragment, and which of two polygons is nearer?
//
// A plane is its provenance (light_planes.h), and a vertex is an input vertex or the ray in which
// the planes of its two edges meet. Both carry doubles with proven error bounds. Decisions go down
// the ladder of staged_sign.h: filter, identity, integers made from the provenance.
//
// Guarantee: every decision is exact on every input, whatever the magnitudes.
// Degree: 3 for input vertices, 6 for crossings, 9 / 12 / 15 with one, two, three cuts.
// Reference: Chin & Feiner 1989, sec. 4; docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_LIGHT_SPACE_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_LIGHT_SPACE_H

#include <array>
#include <cstdint>
#include <vector>

#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/implicit/implicit_scene_space.h"
#include "kernel/implicit/light_positions.h"
#include "kernel/implicit/staged_sign.h"

namespace gnomon {

template <class Stats = NoStats>
class ImplicitLightSpace : public LightPositions {
 public:
  using SceneSpace = ImplicitSceneSpace<Stats>;
  static constexpr bool kExact = true;
  static constexpr bool kParallel = true;

  ImplicitLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions&)
      : LightPositions(scene, light) {}
  /// See the concept SectorSpaceModel.
  ImplicitLightSpace fork() const {
    ImplicitLightSpace result = *this;
    result.stages_ = {};
    return result;
  }

  /// Sign of a support plane at the light: positive where its front faces the light, negative where
  /// its back does, zero exactly where the light is in the plane.
  /// Exactness: exact; decided by integers when the space is made, and not counted. Degree: 3, or 2
  /// and 1 in the direction. Bits: those of side_of_support_bits() with the light among the
  /// positions, or of side_of_edge_bits().
  Sign light_side(PlaneId plane) const { return depth(plane).at_light; }

  /// The side of a plane through the light, in the orientation of the reference, on which the ray
  /// of the corner lies: kFront where n . r is positive (the interior of the loop whose edge the
  /// plane is), kOn exactly where it is zero, kBack where it is negative. Identities: (1), (3) of
  /// plane_provenance.h. Requires: the planes of a made corner's edges are not one. Exactness:
  /// exact, on every input. Degree and bits: an input vertex 3 against the plane of an edge,
  /// side_of_edge_bits(), and 6 against a cut, side_of_input_vertex_bits(); a crossing 6, and 3
  /// more for each cut among the three planes, side_of_crossing_bits(). For a directional light 2
  /// less in positions and up to 3 in the direction. Reference: Chin & Feiner 1989, sec. 4;
  /// docs/exactness.md, "In light space".
  Side side_of_plane(const LoadedPlane& plane, const Corner<Vertex>& corner) {
    const std::array<double, 3>& r = corner.vertex.ray;
    const double value = plane.n[0] * r[0] + plane.n[1] * r[1] + plane.n[2] * r[2];
    return stages_.filtered(value, plane.slack * static_cast<double>(corner.vertex.bound),
                            plane.plane.flipped(),
                            [&] { return undecided_side(plane.plane, corner); });
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    return side_of_plane(load(plane), corner);
  }

  /// The side of another support plane, in its own orientation, on which the corner's point on the
  /// support plane of its loop lies: kFront where it is in front of `plane`, kOn exactly where it
  /// is on it, kBack where it is behind. So it compares depths: which of two polygons is nearer to
  /// the light along a ray. Identities: (2), (3), (5) of plane_provenance.h; besides, a point of an
  /// input edge of the loop lies between the edge's ends, and exact answers for input vertices are
  /// remembered (both count as identity). Requires: the light is in neither of the two planes.
  /// Exactness: exact, on every input. Degree and bits: an input vertex 3, side_of_support_bits();
  /// a crossing 9 and 3 more for each cut, side_of_crossing_bits() with cut_plane_bits().
  /// Reference: docs/exactness.md.
  Side side_of_support(PlaneId plane, const Corner<Vertex>& corner);

  /// The same decisions about input vertices by identity and integers alone, for callers that have
  /// filtered them by numbers of their own: the side of the shadow plane of an input edge (by
  /// EdgeId, interior in front), and of a support plane in its own orientation.
  Side side_of_edge(PlaneRef edge, VertexId vertex) {
    if (is_made_from(ends_of(edge), vertex)) return stages_.known_on();  // identity (3)
    const Sign sign = exact_side_of_input(PlaneRef(edge.index()), vertex);
    return side_of(edge.flipped() ? -sign : sign);
  }
  Side side_of_support_at(PlaneId plane, VertexId vertex) {
    return side_of(input_depth(plane, vertex));
  }

  StageCounts stage_counts() const { return stages_.counts(); }

 private:
  Side undecided_side(PlaneRef plane, const Corner<Vertex>& corner);
  Sign exact_side_of_input(PlaneRef plane, VertexId vertex);
  Sign exact_side_of_crossing(PlaneRef plane, const Corner<Vertex>& corner);
  Side undecided_depth(PlaneId plane, const Corner<Vertex>& corner);
  /// Whether the point where an edge and a plane through the light meet lies between the edge's
  /// ends, and at neither of them.
  bool is_between(const EdgeEnds& ends, PlaneRef cut);
  Sign exact_depth_of_crossing(PlaneId plane, const Corner<Vertex>& corner);
  Sign input_depth(PlaneId plane, VertexId vertex);

  /// Exact depths of input vertices found lately: neighbours in a scene ask again and again.
  struct DepthMemo {
    std::uint64_t key = 0;  // (plane, vertex) + 1
    Sign sign = Sign::kZero;
  };
  std::vector<DepthMemo> depth_memo_ = std::vector<DepthMemo>(1024);
  [[no_unique_address]] StagedSign<Stats> stages_;
};

extern template class ImplicitLightSpace<NoStats>;
extern template class ImplicitLightSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_LIGHT_SPACE_H
