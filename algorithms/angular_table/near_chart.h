// SPDX-License-Identifier: LGPL-3.0-or-later
// A chart in doubles: where a sample is, about, for guesses that are confirmed; and distances that
// are linear in the angle, which nothing confirms (interpolate=linear).
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_NEAR_CHART_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_NEAR_CHART_H

#include <array>

#include "algorithms/angular_table/table_chart.h"
#include "gnomon/kernel/image_frame.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Scene units.
using NearPoint = std::array<double, 3>;

/// Where the ray of a sample meets the part's plane; no number where it does not.
NearPoint near_point(const PreparedScene& scene, const ImageFrame& frame, std::uint32_t part,
                     ImageSample sample);

class NearChart {
 public:
  NearChart(const Geometry& geometry, const TableChart& chart, const LightPoint& light);

  double s(const NearPoint& x) const { return value(0, x) / value(2, x); }
  double t(const NearPoint& x) const { return value(1, x) / value(2, x); }
  /// From the lamp, scene units. Requires: the light is no sun.
  double distance(const NearPoint& x) const;
  /// Of the part's plane in this direction, from the lamp. Requires: the light is no sun.
  double distance_of_plane(const PreparedScene& scene, std::uint32_t part, double s,
                           double t) const;

 private:
  double value(std::size_t k, const NearPoint& x) const {
    return n_[k][0] * x[0] + n_[k][1] * x[1] + n_[k][2] * x[2] - d_[k];
  }

  std::array<NearPoint, 3> n_;  // of alpha, beta and gamma
  std::array<double, 3> d_{};
  NearPoint light_;
};

/// A value that goes from `first` at the angle of s = `low` to `second` at that of `high`, linear
/// in the angle.
double linear_in_angle(double low, double first, double high, double second, double s);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_NEAR_CHART_H
