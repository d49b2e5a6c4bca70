// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `plane` in three dimensions with planes through three corners: where shadow volumes of
// area lights are made, and loops are cut by them.
//
// A plane is its provenance (volume_planes.h), a vertex an input vertex or the point where the
// planes that its corner names meet (volume_points.h). Both carry doubles with proven error bounds.
// Decisions go down the ladder of staged_sign.h: filter, identity, integers of the width that the
// bits of the planes at hand ask for.
//
// Guarantee: every decision is exact on every input, whatever the magnitudes.
// Degree: 3 (input vertex), 6 (edge and plane), 9 (three planes), while the light is not cut.
// Reference: Chin & Feiner 1992, sec. 3; docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_VOLUME_SPACE_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_VOLUME_SPACE_H

#include <array>

#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/implicit/implicit_scene_space.h"
#include "kernel/implicit/staged_sign.h"
#include "kernel/implicit/volume_construction.h"

namespace gnomon {

template <class Stats = NoStats>
class ImplicitVolumeSpace : public VolumeConstruction {
 public:
  using SceneSpace = ImplicitSceneSpace<Stats>;
  static constexpr bool kExact = true;
  static constexpr bool kParallel = true;

  ImplicitVolumeSpace(const SceneSpace& scene, const KernelOptions&)
      : VolumeConstruction(scene.geometry()) {}
  ImplicitVolumeSpace fork() const {
    ImplicitVolumeSpace result = *this;
    result.stages_ = {};
    return result;
  }

  /// The side of a plane, in the orientation of the reference, on which the corner's point lies:
  /// kFront where n . x - d is positive, kOn exactly where it is zero, kBack where it is negative.
  /// Identities: (1), (2), (3), (4) of plane_provenance.h.
  /// Requires: `plane` is no input edge; a made corner is one point, where the planes that it names
  /// meet. Exactness: exact, on every input. Degree and bits, while the light is not cut, for b-bit
  /// positions: an input vertex 3, support_value_bits() + 1; a point on an input edge 6,
  /// volume_edge_bits(); a point of three planes 9, volume_meet_bits(). For planes that go through
  /// corners of a cut light: volume_precision_plan(). Reference: docs/exactness.md, "Shadow volumes
  /// of area lights".
  Side side_of_plane(const LoadedPlane& plane, const Corner<Vertex>& corner) {
    const std::array<double, 3>& x = corner.vertex.x;
    const double value = plane.n[0] * x[0] + plane.n[1] * x[1] + plane.n[2] * x[2] - plane.d;
    return stages_.filtered(value, static_cast<double>(corner.vertex.bound), plane.plane.flipped(),
                            [&] { return undecided_side(plane.plane, corner); });
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    return side_of_plane(load(plane), corner);
  }

  StageCounts stage_counts() const { return stages_.counts(); }

 private:
  Side undecided_side(PlaneRef plane, const Corner<Vertex>& corner);
  bool is_known_on(PlaneRef plane, const Corner<Vertex>& corner) const;
  Sign exact_side(const Plane& plane, const Corner<Vertex>& corner);
  Sign exact_side_of_input(const Plane& plane, VertexId v);
  Sign exact_side_of_edge_point(const Plane& plane, const EdgePoint& point);
  Sign exact_side_of_meet(const Plane& plane, const Meet& meet);
  static VertexId best_pivot(const Plane& plane, const Meet& meet);

  template <class Predicate>
  Sign decide(unsigned factor_bits, unsigned width_bits, const Predicate& predicate) {
    return stages_.exact(width_of(is_fixed(), width_bits), std::max(factor_bits, grid_bits()),
                         predicate);
  }

  [[no_unique_address]] StagedSign<Stats> stages_;
};

extern template class ImplicitVolumeSpace<NoStats>;
extern template class ImplicitVolumeSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_VOLUME_SPACE_H
