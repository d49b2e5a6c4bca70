// SPDX-License-Identifier: LGPL-3.0-or-later
// The points of corners under a far lamp in doubles: on the scale of the scene, not of the lamp's
// distance. Bodies of light_positions.h.
#include <algorithm>
#include <cmath>

#include "kernel/implicit/light_positions.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon {

// With M the largest component of the depth plane, a ray off by e and of size m, and |d_k| <= 1 off
// by 2u: g is off by LightBounds::depth(), g d_k by that and 3u |g|, a numerator by e and u of
// itself besides, and t by e, nearness times the error of g, and u of itself.
LightPositions::FarPoint LightPositions::far_point(const Corner<Vertex>& corner) const {
  const std::array<double, 3>& r = corner.vertex.ray;
  const DepthPlane& plane = depth(corner.support);
  const double error = error_of(corner.vertex);
  const double size = corner.vertex.source == kMadeVertex ? LightBounds::kMadeMagnitude : 1;
  const auto [x, y, z] = integers().axes;
  const std::array<Ball, 3>& d = frame_->light;
  const double g =
      (plane.n[0] * r[0] + plane.n[1] * r[1] + plane.n[2] * r[2]) * (d[z].middle < 0 ? -1 : 1);
  const double g_error = LightBounds::depth(plane.magnitude, error, size);
  FarPoint point;
  point.over[x] = r[0] + g * d[x].middle;
  point.over[y] = r[1] + g * d[y].middle;
  point.over[z] = g * d[z].middle;
  point.under = r[2] + frame_->nearness * g;
  constexpr double kUnit = Ball::kUnit;
  point.over_error = 1.01 * (error + g_error + kUnit * (4 * std::fabs(g) + size));
  point.under_error =
      1.01 * (error + frame_->nearness * (g_error + kUnit * std::fabs(g)) + kUnit * size);
  return point;
}

PlanarPoint LightPositions::far_planar_point(const Corner<Vertex>& corner) const {
  const auto [u, v] = kept_under_far(depth(corner.support));
  PlanarPoint result;
  if (corner.vertex.source != kMadeVertex) {
    const double scale = std::ldexp(1.0, -static_cast<int>(geometry().grid.bits()));
    const auto along = [&](int axis) {
      const GridPositions& grid = geometry().grid;
      return grid.is_narrow()
                 ? static_cast<double>(grid.narrow(corner.vertex.source, axis)) * scale
                 : to_double_scaled(grid.wide(corner.vertex.source, axis), long{grid.bits()});
    };
    result.x = along(u);
    result.y = along(v);
    result.error = 2 * Ball::kUnit * std::max(result.x, result.y);
    return result;
  }
  const FarPoint point = far_point(corner);
  result.error = kUnknownError;
  const double inverse = 1 / point.under, relative = point.under_error * std::fabs(inverse);
  if (!(relative < LightBounds::kMostRelative)) return result;
  result.x = point.over[static_cast<std::size_t>(u)] * inverse;
  result.y = point.over[static_cast<std::size_t>(v)] * inverse;
  const double most = std::max(std::fabs(result.x), std::fabs(result.y));
  result.error = 1.01 * (point.over_error * std::fabs(inverse) + most * relative) +
                 LightBounds::kQuotient * most;
  return result;
}

// In a chart of q, for methods that divide what is around a lamp: q_z = r_z and q_x = (r_z d_x -
// nearness r_x) / d_z, |d_x| <= |d_z| and 1/2 <= |d_z|, off by at most twice e and 2u from d, u
// from roundings of three products, a difference and a quotient, of a size of at most 2.
ChartPoint LightPositions::chart_point_of_lamp(const LightChart& chart,
                                               const Corner<Vertex>& corner) const {
  const auto [x, y, z] = integers().axes;
  const std::array<Ball, 3>& d = frame_->light;
  const std::array<double, 3>& r = corner.vertex.ray;
  std::array<double, 3> q;
  q[static_cast<std::size_t>(x)] = (r[2] * d[x].middle - frame_->nearness * r[0]) / d[z].middle;
  q[static_cast<std::size_t>(y)] = (r[2] * d[y].middle - frame_->nearness * r[1]) / d[z].middle;
  q[static_cast<std::size_t>(z)] = r[2];
  const FarPoint at = far_point(corner);
  const double error = 2.1 * error_of(corner.vertex) + 40 * Ball::kUnit;
  const double w = chart.sign * q[static_cast<std::size_t>(chart.w)];
  ChartPoint point;
  point.uv_error = point.z_error = kUnknownError;
  if (!(error < w * LightBounds::kMostRelative)) return point;
  const double inverse = 1 / w, relative = error * inverse;
  point.u = chart.sign * q[static_cast<std::size_t>(chart.u)] * inverse;
  point.v = chart.sign * q[static_cast<std::size_t>(chart.v)] * inverse;
  point.z = at.under / d[z].middle * inverse;  // n / h . q on the plane itself, where that is 1
  const double most = std::max(std::fabs(point.u), std::fabs(point.v));
  point.uv_error = 1.01 * (1 + most) * relative + LightBounds::kQuotient * most;
  point.z_error = 1.01 * at.under_error / std::fabs(d[z].middle) * inverse +
                  std::fabs(point.z) * (1.01 * relative + 2 * LightBounds::kQuotient);
  return point;
}

}  // namespace gnomon
