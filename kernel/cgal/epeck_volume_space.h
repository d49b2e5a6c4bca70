// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `epeck` in three dimensions, for area lights: planes and crossings are CGAL's lazy
// exact objects on the scene's grid.
//
// Guarantee: exact. Price: see epeck_space.h; and since deciding may evaluate a number that another
// fork holds too, forks are for one thread.
#ifndef GNOMON_KERNEL_CGAL_EPECK_VOLUME_SPACE_H
#define GNOMON_KERNEL_CGAL_EPECK_VOLUME_SPACE_H

#include <gmpxx.h>

#include <array>
#include <optional>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "kernel/cgal/epeck_space.h"
#include "kernel/concept/constructed_volume_space.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/corner.h"

namespace gnomon {

class EpeckVolumeSpace
    : public ConstructedVolumeSpace<EpeckVolumeSpace, EpeckSceneSpace, Epeck::Plane_3> {
  using Base = ConstructedVolumeSpace<EpeckVolumeSpace, EpeckSceneSpace, Epeck::Plane_3>;

 public:
  static constexpr bool kParallel = false;

  EpeckVolumeSpace(const SceneSpace& scene, const KernelOptions& options);

  /// The made vertex where three axis planes meet.
  Vertex axis_point(const std::array<double, 3>& fractions) const;
  /// Fractions of the grid's extent, certified.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// The same as seen from vertex `origin`, with errors that are small against the distance from
  /// it.
  std::array<Ball, 3> offset(VertexId origin, const Corner<Vertex>& corner) const;
  /// Scene units, exact.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// Scene units, the nearest doubles.
  std::array<double, 3> nearest_position(const Corner<Vertex>& corner) const;

 private:
  friend Base;
  using Numbers = std::array<Epeck::FT, 3>;

  /// Divided by the extent.
  std::array<Ball, 3> by_intervals(const Numbers& grid) const;
  std::array<Ball, 3> by_rationals(const Numbers& grid) const;
  std::optional<Epeck::Plane_3> plane_of(const Vertex& a, const Vertex& b, const Vertex& c) const;
  std::optional<Epeck::Plane_3> plane_of(const Vertex& a, const Vertex& b,
                                         const LightPoint& direction) const;
  Epeck::Plane_3 axis_plane(int axis, double value) const;
  Side side(const Epeck::Plane_3& plane, const Vertex& vertex) const;
  Vertex meet(const Epeck::Plane_3& plane, const Vertex& from, const Vertex& to) const;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPECK_VOLUME_SPACE_H
