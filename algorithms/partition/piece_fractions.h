// SPDX-License-Identifier: LGPL-3.0-or-later
// Areas of pieces of a part, in some affine frame of its support plane: enclosed in doubles with
// one error bound a vertex, and exactly.
#ifndef GNOMON_ALGORITHMS_PARTITION_PIECE_FRACTIONS_H
#define GNOMON_ALGORITHMS_PARTITION_PIECE_FRACTIONS_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/partition/fractions.h"
#include "gnomon/scene/prepare.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// The chart of every support plane: which axis to drop.
class PlaneCharts {
 public:
  PlaneCharts() = default;  // of nothing
  explicit PlaneCharts(const Geometry& geometry);
  Chart operator[](PlaneId plane) const {
    const int dropped = dropped_[plane];
    return {(dropped + 1) % 3, (dropped + 2) % 3};
  }

 private:
  std::vector<std::uint8_t> dropped_;
};

/// Coordinates of a corner in an affine frame of the support plane of its loop, the same frame for
/// all loops of that plane.
template <MeasuredSpace Space>
PlanarPoint planar_point(const Space& space, const PlaneCharts& charts,
                         const Corner<typename Space::Vertex>& corner) {
  if constexpr (requires { space.planar_point(corner); }) {
    return space.planar_point(corner);
  } else {
    const std::array<Ball, 3> point = space.position(corner);
    const auto [u, v] = charts[corner.support];
    const double error = point[u].is_finite() && point[v].is_finite()
                             ? std::max(point[u].radius, point[v].radius)
                             : std::numeric_limits<double>::infinity();
    return {point[u].middle, point[v].middle, error};
  }
}

/// Twice the signed area of a loop whose corners are at point_of(corner). Differences from the
/// first vertex err by d = 2e + uD, D the largest of them, so each of the products of neighbours
/// errs by d (|x| + |y|) of both and d^2; a difference is in two of them. Roundings are at most u
/// (n + 3) times the sum of 2 (n - 2) products of at most D^2. The radius is infinite or not a
/// number where nothing is known.
template <class Loop, class PointOf>
Ball twice_area(const Loop& loop, const PointOf& point_of) {
  const PlanarPoint origin = point_of(loop.corner(0));
  double x = 0, y = 0, sum = 0, spread = 0, most = 0, error = origin.error;
  for (std::uint32_t i = 1; i < loop.size(); ++i) {
    const PlanarPoint p = point_of(loop.corner(i));
    const double next_x = p.x - origin.x, next_y = p.y - origin.y;
    sum += x * next_y - y * next_x;
    const double size = std::fabs(next_x) + std::fabs(next_y);
    spread += size;
    most = std::max(most, size);
    error = std::max(error, p.error);
    x = next_x;
    y = next_y;
  }
  const auto n = static_cast<double>(loop.size());
  const double d = 2 * error + Ball::kUnit * most;
  const double radius = 2 * d * (spread + n * d) + 2 * n * (n + 4) * Ball::kUnit * most * most;
  const double overflow = sum - sum;  // not a number if the sum is none; else 0
  return {sum, radius * 1.001 + overflow + Ball::kTiny};
}

/// The same for a loop in light space. Where the bounds of the doubles leave more than `widest`,
/// a kernel that can computes the corners from its integers.
template <MeasuredSpace Space>
Ball twice_area(const Space& space, const PlaneCharts& charts,
                const LoopView<typename Space::Vertex>& loop, double widest) {
  const Ball area =
      twice_area(loop, [&](const auto& corner) { return planar_point(space, charts, corner); });
  if constexpr (requires { space.accurate_planar_point(loop.corner(0)); }) {
    if (!(area.radius < widest)) {
      return twice_area(loop,
                        [&](const auto& corner) { return space.accurate_planar_point(corner); });
    }
  }
  return area;
}

/// Twice the area of a part in scene units, in the chart of its plane; exact.
mpq_class twice_exact_area(const PreparedScene& scene, const Part& part);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_PIECE_FRACTIONS_H
