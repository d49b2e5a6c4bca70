// SPDX-License-Identifier: LGPL-3.0-or-later
// Planes through casters and lights in three dimensions, for the kernels whose vertices are
// coordinates: float, double, long double (rounded), and GMP rationals (exact). The same formulas
// as in coordinate_space.h.
//
// Guarantee: with T = mpq_class every decision and construction is exact. With a float type nothing
// is guaranteed; `identity` and `thickness` (kernel_options.h) are what practice knows.
#ifndef GNOMON_KERNEL_COORDINATE_COORDINATE_VOLUME_SPACE_H
#define GNOMON_KERNEL_COORDINATE_COORDINATE_VOLUME_SPACE_H

#include <gmpxx.h>

#include <array>
#include <optional>
#include <type_traits>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "kernel/concept/constructed_volume_space.h"
#include "kernel/coordinate/coordinate_space.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/corner.h"

namespace gnomon {

template <class T>
class CoordinateVolumeSpace
    : public ConstructedVolumeSpace<CoordinateVolumeSpace<T>, CoordinateSceneSpace<T>,
                                    CoordinatePlane<T>> {
  using Base =
      ConstructedVolumeSpace<CoordinateVolumeSpace, CoordinateSceneSpace<T>, CoordinatePlane<T>>;

 public:
  using SceneSpace = CoordinateSceneSpace<T>;
  using Vertex = CoordinateVertex<T>;
  static constexpr bool kExact = SceneSpace::kExact;
  /// GMP numbers are only read by what forks share.
  static constexpr bool kParallel = true;

  CoordinateVolumeSpace(const SceneSpace& scene, const KernelOptions& options);

  /// The made vertex where three axis planes meet.
  Vertex axis_point(const std::array<double, 3>& fractions) const;
  /// Fractions of the grid's extent. With a float type, of radius 0 around the rounded numbers.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// The same as seen from vertex `origin`, with errors that are small against the distances from
  /// it: areas of small polygons are then not measured on the scale of the scene.
  std::array<Ball, 3> offset(
      VertexId origin, const Corner<Vertex>& corner) const requires std::is_same_v<T, mpq_class>;
  /// Scene units: the kernel's own numbers, exactly.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// Scene units: the doubles nearest to the kernel's own numbers.
  std::array<double, 3> nearest_position(const Corner<Vertex>& corner) const;

 private:
  friend Base;
  using Wide = std::conditional_t<std::is_same_v<T, float>, double, T>;

  /// Nothing if the normal is zero or not finite: with a float type, after rounding.
  std::optional<CoordinatePlane<T>> plane_from(std::array<T, 3> normal,
                                               const std::array<T, 3>& point) const;
  std::optional<CoordinatePlane<T>> plane_of(const Vertex& a, const Vertex& b,
                                             const Vertex& c) const;
  std::optional<CoordinatePlane<T>> plane_of(const Vertex& a, const Vertex& b,
                                             const LightPoint& direction) const;
  CoordinatePlane<T> axis_plane(int axis, double value) const;
  Side side(const CoordinatePlane<T>& plane, const Vertex& vertex) const {
    return planes_.side(plane, vertex);
  }
  Vertex meet(const CoordinatePlane<T>& plane, const Vertex& from, const Vertex& to) const {
    return planes_.crossing(plane, from, to);
  }

  CoordinatePlanes<T> planes_;  // the scene space's
  std::array<Wide, 3> origin_;
  Wide inverse_extent_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_COORDINATE_COORDINATE_VOLUME_SPACE_H
