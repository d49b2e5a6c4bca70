// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `plane` in three dimensions, where the scene BSP decides: on which side of the support
// plane P_j does a vertex of a fragment lie?
//
// A vertex is never constructed. It is an input vertex, or where an input edge meets a support
// plane, or where two support planes cut the support plane of the loop; its doubles are a hint with
// a proven error bound (scene_planes.h). Decisions go down the ladder of staged_sign.h.
//
// Guarantee: every side is exact, on every input.
// Degree: 3 (input vertex), 6 (edge and plane), 9 (three planes). Reference: docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_SCENE_SPACE_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_SCENE_SPACE_H

#include <array>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/implicit/exact_geometry.h"
#include "kernel/implicit/scene_planes.h"
#include "kernel/implicit/staged_sign.h"
#include "kernel/signs/corner.h"

namespace gnomon {

template <class Stats = NoStats>
class ImplicitSceneSpace : public ScenePlanes {
 public:
  static constexpr bool kExact = true;

  ImplicitSceneSpace(const Geometry& geometry, const KernelOptions&) : ScenePlanes(geometry) {}

  /// The side of support plane `plane`, in the orientation of the reference, on which the corner's
  /// vertex lies: kFront where n . x - d is positive, kOn exactly where it is zero, kBack where it
  /// is negative. Identities: (1), (2), (3) of plane_provenance.h.
  /// Requires: `plane` is no input edge; a made corner is one point, where the planes that it names
  /// meet. Exactness: exact, on every input. Degree and bits, for b-bit positions: an input vertex
  /// 3, side_of_support_bits(); a point on an input edge 6, edge_against_plane_bits(); a point of
  /// three planes 9, four_planes_bits(). Reference: docs/exactness.md, "In space: the scene BSP".
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner);

  StageCounts stage_counts() const { return stages_.counts(); }

 private:
  bool is_known_on(PlaneRef plane, const Corner<Vertex>& corner) const;
  Sign exact_side(PlaneId plane, const Corner<Vertex>& corner);
  Sign exact_side_of_edge_point(PlaneId plane, EdgeId edge, PlaneId cut);
  Sign exact_side_of_plane_point(PlaneId plane, const std::array<PlaneId, 3>& meeting);

  [[no_unique_address]] StagedSign<Stats> stages_;
};

extern template class ImplicitSceneSpace<NoStats>;
extern template class ImplicitSceneSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_SCENE_SPACE_H
