// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the lines of a shading mesh's grids are, and the planes that they are drawn on.
//
// Exactness: a point's place among the lines is exact, also where the lines are at rounded numbers.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_GRID_LINES_H
#define GNOMON_ALGORITHMS_SHADING_MESH_GRID_LINES_H

#include <gmpxx.h>

#include <array>
#include <cstdint>

#include "algorithms/shading_mesh/points.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// GridLines says where the lines of a grid are, along any axis.
class GridLines {
 public:
  /// Numbers of lines stay below this, so that places are 64-bit integers and rounded lines stay
  /// in order.
  static constexpr double kMostLines = 0x1p40;

  GridLines() = default;  // none
  /// `rounded`: at the doubles nearest to the multiples of the step. Requires: step > 0.
  GridLines(mpq_class step, bool rounded);

  bool empty() const { return sgn(step_) == 0; }
  double step() const { return step_.get_d(); }
  mpq_class at(std::int64_t line) const;
  /// 2k if the coordinate is that of line k, 2k + 1 if it is between the lines k and k + 1.
  /// Requires: fewer than kMostLines lines away from 0.
  std::int64_t place(const PointTable& points, std::uint32_t point, int axis) const;

 private:
  double rounded_at(std::int64_t line) const;

  mpq_class step_;
  double nearest_step_ = 0;
  // Terms of a fraction that are doubles: quotients of doubles are rounded to the nearest.
  bool is_short_ = false;
  bool rounded_ = false;
};

/// A support plane as n . x = d in scene units, and the two axes of its chart.
struct MeshPlane {
  std::array<mpz_class, 3> n;
  mpq_class d;
  std::array<int, 2> axes{};

  int dropped() const { return 3 - axes[0] - axes[1]; }
};
MeshPlane mesh_plane(const PreparedScene& scene, PlaneId plane);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_GRID_LINES_H
