// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `epick` in three dimensions, for area lights: a plane is three rounded points, or two
// and a direction, and CGAL's exact orientation tells the side of a fourth.
//
// Guarantee: each decision is exact *for the rounded points*; crossings are rounded to doubles. See
// epick_space.h.
#ifndef GNOMON_KERNEL_CGAL_EPICK_VOLUME_SPACE_H
#define GNOMON_KERNEL_CGAL_EPICK_VOLUME_SPACE_H

#include <gmpxx.h>

#include <array>
#include <optional>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "kernel/cgal/epick_space.h"
#include "kernel/concept/constructed_volume_space.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/corner.h"

namespace gnomon {

class EpickVolumeSpace
    : public ConstructedVolumeSpace<EpickVolumeSpace, EpickSceneSpace, EpickPlane> {
  using Base = ConstructedVolumeSpace<EpickVolumeSpace, EpickSceneSpace, EpickPlane>;

 public:
  /// CGAL's filtered predicates keep no state.
  static constexpr bool kParallel = true;

  EpickVolumeSpace(const SceneSpace& scene, const KernelOptions& options);

  /// The made vertex where three axis planes meet.
  Vertex axis_point(const std::array<double, 3>& fractions) const;
  /// Fractions of the grid's extent, of radius 0 around the rounded numbers.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// Scene units: the kernel's own doubles.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  std::array<double, 3> nearest_position(const Corner<Vertex>& corner) const {
    return corner.vertex.x;
  }

 private:
  friend Base;
  /// Nothing if the rounded points are on one line, exactly, or not finite.
  std::optional<EpickPlane> plane_of(const Vertex& a, const Vertex& b, const Vertex& c) const;
  std::optional<EpickPlane> plane_of(const Vertex& a, const Vertex& b,
                                     const LightPoint& direction) const;
  EpickPlane axis_plane(int axis, double value) const;
  Side side(const EpickPlane& plane, const Vertex& vertex) const;
  Vertex meet(const EpickPlane& plane, const Vertex& from, const Vertex& to) const;

  std::array<double, 3> origin_;
  double inverse_extent_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPICK_VOLUME_SPACE_H
