// SPDX-License-Identifier: LGPL-3.0-or-later
// The formulas of ChartPoint (light_space.h), for kernels that have the coordinates of a point: in
// floating-point numbers for rounded kernels, in balls for exact ones.
//
// With q = L - x for a point light: u = q_u / q_w, v = q_v / q_w, z = 1 / |q_w|. For a directional
// light, with d_z its largest component and p = x - origin: u = (p_x - p_z d_x / d_z) / extent, v
// alike, extent = 2^b grid steps.
//
// Guarantee: the errors are proven bounds, infinite where overflow, underflow or an unknown sign of
// q_w leave nothing to say.
// Tests: tests/kernel/sector_space_test.h holds charts against rational ones, by these bounds.
#ifndef GNOMON_KERNEL_CONCEPT_CHART_FORMULAS_H
#define GNOMON_KERNEL_CONCEPT_CHART_FORMULAS_H

#include <array>
#include <cmath>
#include <limits>

#include "gnomon/kernel/geometry.h"
#include "kernel/concept/light_space.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {

inline constexpr ChartPoint kUnknownChartPoint{0, 0, 0, std::numeric_limits<double>::infinity(),
                                               std::numeric_limits<double>::infinity()};

/// 2^b grid steps in scene units.
inline mpq_class grid_extent(const Geometry& geometry) {
  return geometry.step * mpq_class(mpz_class(1) << geometry.grid.bits());
}

/// For rounded coordinates. Coordinates and light are taken as the kernel has them; origin and
/// extent are those of the geometry, exactly. W is double or long double; kernels with less
/// precision convert without loss.
template <class W>
class RoundedChart {
 public:
  /// Of z = 1 / |q_w|: q_w and the quotient are rounded, 2u, and u for terms of higher order and
  /// the conversion of a long double.
  static constexpr double kDepthError = 3 * Ball::kUnit;
  /// Of u = q_u z: q_u, z (2u) and the product are rounded, 4u, and u as above.
  static constexpr double kPointError = 5 * Ball::kUnit;
  /// Of u for a directional light, relative to |p_x| + |p_y| + |p_z|. |d_x / d_z| <= 1. Rounding
  /// p_x errs by u |p_x|; d_x / d_z, p_z and their product by u |p_z| each; the difference by u
  /// (|p_x| + |p_z|); 1 / extent (of a rounded extent, 2u) and the product by 3u of that. 5u |p_x|
  /// + 7u |p_z|, and u as above.
  static constexpr double kDirectionalError = 8 * Ball::kUnit;

  RoundedChart(const Geometry& geometry, const LightPoint& light, const std::array<W, 3>& kept)
      : directional_(light.directional), axes_(LightAxes::of(light)), light_(kept) {
    if (!directional_) return;
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      const double origin = nearest_double(geometry.origin[k]);
      origin_[k] = origin;
      largest = std::fmax(largest, std::fabs(origin));
    }
    slope_x_ = light_[axes_.x] / light_[axes_.z];
    slope_y_ = light_[axes_.y] / light_[axes_.z];
    sign_ = light_[axes_.z] < 0 ? -1 : 1;
    const double extent = nearest_double(grid_extent(geometry));
    const bool usable = extent > 0x1p-1000 && extent < 0x1p1000 && std::isfinite(slope_x_) &&
                        std::isfinite(slope_y_) && std::isfinite(largest);
    inverse_extent_ = usable ? 1 / extent : std::numeric_limits<double>::quiet_NaN();
    error_ = kDirectionalError * inverse_extent_;
    // The origin's rounding, u |origin| in p_x and in p_z; underflow of a product.
    least_error_ = inverse_extent_ * (3 * Ball::kUnit * largest + Ball::kTiny) + Ball::kTiny;
  }

  template <class T>
  ChartPoint operator()(const LightChart& chart, const std::array<T, 3>& x) const {
    return directional_ ? along(x) : around(chart, x);
  }

 private:
  // Between these 1 / q_w neither over- nor underflows.
  static constexpr double kLeast = 0x1p-1020, kMost = 0x1p1020;
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  template <class T>
  ChartPoint around(const LightChart& chart, const std::array<T, 3>& x) const {
    const W sign = chart.sign;
    const W w = sign * (light_[chart.w] - x[chart.w]);
    if (!(w > kLeast && w < kMost)) return kUnknownChartPoint;
    const W z = 1 / w;
    const W signed_z = sign * z;
    ChartPoint point;
    point.u = static_cast<double>((light_[chart.u] - x[chart.u]) * signed_z);
    point.v = static_cast<double>((light_[chart.v] - x[chart.v]) * signed_z);
    point.z = static_cast<double>(z);
    const double size = std::fabs(point.u) + std::fabs(point.v);
    if (!(size < kInfinity)) return kUnknownChartPoint;
    point.uv_error = kPointError * size + Ball::kTiny;
    point.z_error = kDepthError * point.z;
    return point;
  }

  template <class T>
  ChartPoint along(const std::array<T, 3>& x) const {
    const W px = x[axes_.x] - origin_[axes_.x], py = x[axes_.y] - origin_[axes_.y],
            pz = x[axes_.z] - origin_[axes_.z];
    ChartPoint point;
    point.u = static_cast<double>((px - pz * slope_x_) * inverse_extent_);
    point.v = static_cast<double>((py - pz * slope_y_) * inverse_extent_);
    point.z = static_cast<double>(sign_ * x[axes_.z]);
    point.uv_error =
        error_ * static_cast<double>(std::fabs(px) + std::fabs(py) + std::fabs(pz)) + least_error_;
    // Only a long double is rounded.
    point.z_error = sizeof(T) > sizeof(double) ? kDepthError * std::fabs(point.z) + Ball::kTiny : 0;
    const double size = std::fabs(point.u) + std::fabs(point.v) + std::fabs(point.z);
    return size + point.uv_error < kInfinity ? point : kUnknownChartPoint;
  }

  bool directional_;
  LightAxes axes_;
  std::array<W, 3> light_;
  std::array<W, 3> origin_{};
  W slope_x_ = 0, slope_y_ = 0, sign_ = 1, inverse_extent_ = 1;
  double error_ = 0, least_error_ = 0;
};

/// For exact coordinates, enclosed. Units are the caller's: scene units or grid steps.
class EnclosedChart {
 public:
  /// `extent`: 2^b grid steps in the caller's unit.
  EnclosedChart(const LightPoint& light, const mpq_class& extent)
      : directional_(light.directional), axes_(LightAxes::of(light)) {
    if (!directional_) return;
    const auto slope = [&](int k) {
      mpq_class ratio(light.grid[static_cast<std::size_t>(k)],
                      light.grid[static_cast<std::size_t>(axes_.z)]);
      ratio.canonicalize();
      return enclose(ratio);
    };
    slope_x_ = slope(axes_.x);
    slope_y_ = slope(axes_.y);
    negative_ = sgn(light.grid[static_cast<std::size_t>(axes_.z)]) < 0;
    inverse_extent_ = enclose(1 / extent);
  }

  /// `from`: L - x for a point light, x - origin for a directional one.
  ChartPoint operator()(const LightChart& chart, const std::array<Ball, 3>& from) const {
    Ball u, v, z;
    if (directional_) {
      const Ball& depth = from[axes_.z];
      u = (from[axes_.x] - depth * slope_x_) * inverse_extent_;
      v = (from[axes_.y] - depth * slope_y_) * inverse_extent_;
      z = negative_ ? -depth : depth;
    } else {
      const Ball w = chart.sign < 0 ? -from[chart.w] : from[chart.w];
      if (!(w.lower() > 0)) return kUnknownChartPoint;
      z = Ball(1) / w;
      u = from[chart.u] / from[chart.w];
      v = from[chart.v] / from[chart.w];
    }
    if (!u.is_finite() || !v.is_finite() || !z.is_finite()) return kUnknownChartPoint;
    return {u.middle, v.middle, z.middle, std::fmax(u.radius, v.radius), z.radius};
  }

 private:
  bool directional_;
  bool negative_ = false;
  LightAxes axes_;
  Ball slope_x_, slope_y_, inverse_extent_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_CHART_FORMULAS_H
