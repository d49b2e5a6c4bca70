// SPDX-License-Identifier: GPL-3.0-or-later
// A frame of a plane: two axes at right angles of length one, so that distances in it are those in
// space, in scene units and in extended precision (planar_loop.h).
//
// Exactness: axes and lines are made of exact integers, and each number is rounded once. With M the
// greatest distance of a coordinate from 0, a coordinate in the frame is off by at most
// kPlanarError M: a coordinate in space and the frame's origin by 2^-63 M each, their difference by
// as much, times the sum of an axis' components (sqrt(3)), and the axis itself by 2^-62 over a
// distance of at most 2 sqrt(3) M.
#ifndef GNOMON_ORACLE_GEOMETRY_PLANE_FRAME_H
#define GNOMON_ORACLE_GEOMETRY_PLANE_FRAME_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "gnomon/kernel/geometry.h"
#include "gnomon/result/claims.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/planar_loop.h"

namespace gnomon::oracle {

inline constexpr long double kPlanarError = 0x1p-58L;

/// Off by less than 2^-62 of the value.
long double nearest(const mpq_class& value);

class PlaneFrame {
 public:
  /// Of a planar loop on the grid, with positive area; x runs along its first edge, and it is
  /// counter-clockwise.
  PlaneFrame(const Geometry& geometry, std::span<const Integers3> loop);

  /// Of a point's foot on the plane.
  PlanarPoint at(const RationalPoint& point) const;
  PlanarPoint at(const HomogeneousPoint& point) const;
  PlanarLoop loop_at(std::span<const RationalPoint> loop) const;
  /// Distance from the plane, positive in front; off by kPlanarError M.
  long double height(const RationalPoint& point) const;
  /// Where a plane of the grid meets this one, with its front inside; nothing if they are parallel.
  /// Off by 2^-60 of the distance that the line has from the frame's origin and the point looked
  /// at.
  std::optional<PlanarLine> trace(const ExactPlane& plane) const;

 private:
  using Vector = std::array<long double, 3>;
  Vector from_origin(const RationalPoint& point) const;

  struct Small {
    std::array<std::int64_t, 3> origin, along, across;
  };

  Integers3 origin_, along_, across_;  // on the grid; axes not of length one
  std::optional<Small> small_;         // the same, if they are small
  long double along_length_ = 1, across_length_ = 1, step_ = 1;
  Vector base_{}, x_axis_{}, y_axis_{}, normal_{};
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_PLANE_FRAME_H
