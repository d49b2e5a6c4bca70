// SPDX-License-Identifier: LGPL-3.0-or-later
// Where a corner of light space is: in a chart of the light, in a frame of its support plane, and
// in the scene, enclosed, exactly, or as nearest doubles.
//
// A corner's point is where its ray from the light meets the support plane of its loop.
//
// Guarantee: errors are proven bounds (LightBounds), infinite where nothing can be said; what is
// called exact is.
#ifndef GNOMON_KERNEL_IMPLICIT_LIGHT_POSITIONS_H
#define GNOMON_KERNEL_IMPLICIT_LIGHT_POSITIONS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "kernel/concept/light_space.h"
#include "kernel/implicit/filter_bounds.h"
#include "kernel/implicit/light_planes.h"
#include "kernel/numbers/double_double.h"
#include "kernel/signs/ball.h"

namespace gnomon {

/// A planar point in pairs of doubles; `error` bounds that of x and of y.
struct PlanarPair {
  DoubleDouble x, y;
  double error = 0;
};

class LightPositions : public LightPlanes {
 public:
  /// Certified for every vertex whose doubles say something.
  ChartPoint chart_point(const LightChart& chart, const Corner<Vertex>& corner) const {
    return is_far() ? chart_point_of_lamp(chart, corner) : chart_point_of_ray(chart, corner);
  }
  /// The same in far_chart().
  ChartPoint far_chart_point(const LightChart& chart, const Corner<Vertex>& corner) const {
    return chart_point_of_ray(chart, corner);
  }
  /// The corner's point in a frame of its support plane: two components of q, scaled; for a
  /// directional light the chart's, which is an affine map of the plane; for a far lamp two
  /// coordinates on the grid's scale.
  PlanarPoint planar_point(const Corner<Vertex>& corner) const;
  /// The same, computed from integers: relative error LightBounds::kAccurate whatever meets there
  /// at what angle.
  PlanarPoint accurate_planar_point(const Corner<Vertex>& corner) const;
  /// The same in pairs: relative error LightBounds::kAccuratePair of the larger coordinate, or
  /// infinite where numbers are beyond the range of pairs.
  PlanarPair pair_planar_point(const Corner<Vertex>& corner) const;
  /// Enclosure of the corner's position on its support plane, in grid units times 2^-b.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// The same, exactly, in scene units.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// The nearest doubles of exact_position(), at a fraction of its cost; nothing where some 100
  /// bits do not tell them (an exact tie, a light in the plane of many bits).
  std::optional<std::array<double, 3>> nearest_position(const Corner<Vertex>& corner) const;

 protected:
  LightPositions(const ScenePlanes& scene, const LightPoint& light);

 private:
  /// The scene's and the light's numbers, rounded. What forks have in common.
  struct Frame {
    double grid_scale = 1;                            // 2^-q_bits, if narrow
    std::array<DoubleDouble, 3> origin;               // of the grid, scene units
    std::array<std::optional<std::int64_t>, 3> zero;  // coordinate 0, if it is on the grid
    DoubleDouble step;                                // scene units per grid unit
    std::array<Ball, 3> light;  // position times 2^-b, or direction times a power of two; of a far
                                // lamp position times 2^-light_bits
    double nearness = 0;        // of a far lamp: 2^(b - light_bits)
  };
  /// A corner in pairs of doubles, in grid units, and the sums of the magnitudes of its terms.
  struct PairPoint {
    std::array<DoubleDouble, 3> x;
    std::array<double, 3> terms{};
  };

  bool is_directional() const { return integers().light.directional; }
  bool is_far() const { return integers().far; }
  bool is_narrow_corner(const Corner<Vertex>& corner) const {
    return integers().narrow && is_narrow(corner.before) && is_narrow(corner.after);
  }
  /// Of a corner under a far lamp: where its ray meets its plane, with the ray's height g there.
  /// With t = r_z + nearness g, which is d_z on the scale of the ray, the point is ((r_x + g d_x) /
  /// t, (r_y + g d_y) / t, g d_z / t), on the grid's scale.
  struct FarPoint {
    std::array<double, 3> over{};  // times t, by axes of the scene
    double under = 0;              // t
    double over_error = 0, under_error = 0;
  };
  FarPoint far_point(const Corner<Vertex>& corner) const;
  PlanarPoint far_planar_point(const Corner<Vertex>& corner) const;
  ChartPoint chart_point_of_lamp(const LightChart& chart, const Corner<Vertex>& corner) const;
  ChartPoint chart_point_of_ray(const LightChart& chart, const Corner<Vertex>& corner) const;
  /// The point's numerators and their denominator, from integers: L (n . r) - h r and n . r.
  template <class Normal, class Int, class Ray>
  std::array<Int, 4> far_quotients(const Vector3<Ray>& ray, PlaneId support) const;
  template <class Factor, class Int>
  PairPoint pair_far_point(const Corner<Vertex>& corner) const;
  /// The two axes of the scene that are kept in the frame of a plane under a far lamp.
  static std::array<int, 2> kept_under_far(const DepthPlane& plane) {
    const int k = plane.steepest;
    return {k == 2 ? 0 : k + 1, k == 0 ? 2 : k - 1};
  }
  /// Of an input vertex and a point light: two components of L - v, each converted once.
  PlanarPoint input_planar_point(const Corner<Vertex>& corner) const {
    const auto [u, v] = kept_axes(depth(corner.support));
    const std::int64_t* x = geometry().grid.narrow_point(corner.vertex.source);
    const std::array<std::int64_t, 3>& l = integers().narrow_light;
    PlanarPoint point;
    point.x = static_cast<double>(l[u] - x[u]) * frame_->grid_scale;
    point.y = static_cast<double>(l[v] - x[v]) * frame_->grid_scale;
    point.error = Ball::kUnit * std::max(std::fabs(point.x), std::fabs(point.y));
    return point;
  }
  /// The two axes that remain when that of the normal's largest component is dropped.
  static std::array<int, 2> kept_axes(const DepthPlane& plane) {
    const double x = std::fabs(plane.n[0]), y = std::fabs(plane.n[1]), z = std::fabs(plane.n[2]);
    if (z >= x && z >= y) return {0, 1};
    return y >= x ? std::array{2, 0} : std::array{1, 2};
  }
  /// The error of a component that a vertex's bound was made from.
  static double error_of(const Vertex& vertex) {
    return LightBounds::component(static_cast<double>(vertex.bound),
                                  vertex.source == kMadeVertex ? LightBounds::kMadeMagnitude : 1);
  }
  unsigned factor_bits(const Corner<Vertex>& corner) const;
  /// How many bits far_quotients() has more than n . r.
  unsigned far_bits() const { return is_far() ? integers().light_bits + 2 : 0; }
  unsigned ray_bits(const Corner<Vertex>& corner) const;
  template <class Normal, class Int, class Ray>
  PlanarPoint quotient_on_plane(const Vector3<Ray>& ray, PlaneId support) const;
  template <class Normal, class Int, class Ray>
  PlanarPair pair_quotient(const Vector3<Ray>& ray, PlaneId support) const;
  template <class Factor, class Int>
  PairPoint pair_point(const Corner<Vertex>& corner) const;
  template <class Factor, class Int>
  PairPoint pair_point_along(const Corner<Vertex>& corner) const;
  bool is_zero(const Corner<Vertex>& corner, int axis) const;
  std::array<mpq_class, 3> exact_grid_position(const Corner<Vertex>& corner) const;

  std::shared_ptr<const Frame> frame_;
};

// In the chart a direction is (r_u, r_v) / |r_w|, and the depth plane gives z. With e the error of
// a component and w = |r_w|, e / w <= 2^-10, quotients err by (1 + |u|) e / w (1 + 2^-9) and three
// roundings.
inline ChartPoint LightPositions::chart_point_of_ray(const LightChart& chart,
                                                     const Corner<Vertex>& corner) const {
  const std::array<double, 3>& r = corner.vertex.ray;
  const DepthPlane& plane = depth(corner.support);
  const double error = error_of(corner.vertex);
  const double w = chart.sign * r[chart.w];
  ChartPoint point;
  point.uv_error = point.z_error = kUnknownError;
  if (!(error < w * LightBounds::kMostRelative)) return point;
  const double inverse = 1 / w, relative = error * inverse;
  point.u = chart.sign * r[chart.u] * inverse;
  point.v = chart.sign * r[chart.v] * inverse;
  point.z = (plane.n[0] * r[0] + plane.n[1] * r[1] + plane.n[2] * r[2]) * inverse;
  const double most = std::max(std::fabs(point.u), std::fabs(point.v));
  point.uv_error = 1.01 * (1 + most) * relative + LightBounds::kQuotient * most;
  point.z_error =
      1.01 * LightBounds::depth(plane.magnitude, error, LightBounds::kMadeMagnitude) * inverse +
      std::fabs(point.z) * (1.01 * relative + LightBounds::kQuotient);
  return point;
}

// On the ray r the plane is met in q = r / (depth . r); errors as in chart_point.
inline PlanarPoint LightPositions::planar_point(const Corner<Vertex>& corner) const {
  if (is_far()) return far_planar_point(corner);
  const std::array<double, 3>& r = corner.vertex.ray;
  const double error = error_of(corner.vertex);
  PlanarPoint point;
  if (corner.vertex.source != kMadeVertex && integers().narrow && !is_directional()) {
    return input_planar_point(corner);
  }
  point.error = kUnknownError;
  double inverse, relative;
  if (is_directional()) {
    inverse = 1 / r[2];
    relative = error * std::fabs(inverse);
    point.x = r[0] * inverse;
    point.y = r[1] * inverse;
  } else {
    const DepthPlane& plane = depth(corner.support);
    const double magnitude = std::max({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2])});
    inverse = 1 / (plane.n[0] * r[0] + plane.n[1] * r[1] + plane.n[2] * r[2]);
    relative = LightBounds::depth(plane.magnitude, error, magnitude) * std::fabs(inverse);
    const auto [u, v] = kept_axes(plane);
    point.x = r[u] * inverse;
    point.y = r[v] * inverse;
  }
  if (!(relative < LightBounds::kMostRelative)) return point;
  const double most = std::max(std::fabs(point.x), std::fabs(point.y));
  point.error =
      1.01 * (error * std::fabs(inverse) + most * relative) + LightBounds::kQuotient * most;
  return point;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_LIGHT_POSITIONS_H
