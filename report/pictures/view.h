// SPDX-License-Identifier: GPL-3.0-or-later
// From scene space to the pixels of a picture, in doubles.
#ifndef GNOMON_REPORT_PICTURES_VIEW_H
#define GNOMON_REPORT_PICTURES_VIEW_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "report/pictures/flat_geometry.h"
#include "report/pictures/picture.h"
#include "report/pictures/svg.h"

namespace gnomon::report {

/// Scene to pixels.
class View {
 public:
  View(const Camera& camera, double left, double top, double width, double height, double size,
       const std::vector<Vector>& scene)
      : eye_(camera.eye), centre_{left + width / 2, top + height / 2} {
    forward_ = unit(camera.look_at - camera.eye);
    right_ = unit(cross(forward_, camera.up));
    if (length(right_) < 1e-9) right_ = unit(cross(forward_, Vector{0, 1, 0}));
    up_ = cross(right_, forward_);
    const double larger = std::max(width, height);
    scale_ = camera.field_of_view > 0
                 ? larger / 2 / std::tan(camera.field_of_view * std::numbers::pi / 360)
                 : 0;
    frame(scene, width, height, camera.centre_scene);
    // A little beyond the frame on every side, so that outlines end outside of it.
    slope_x_ = width / 2 / scale_ * 1.02;
    slope_y_ = height / 2 / scale_ * 1.02;
    near_ = size * 1e-5;
  }

  /// In the camera's axes: right, up, forward; cut to what the frame shows.
  std::vector<Vector> visible(const std::vector<Vector>& loop) const {
    std::vector<Vector> result;
    for (const Vector& point : loop) {
      const Vector d = point - eye_;
      result.push_back({dot(d, right_), dot(d, up_), dot(d, forward_)});
    }
    result = clipped(result, {0, 0, 1}, near_);
    for (const Vector& inward :
         {Vector{1, 0, slope_x_ - shift_[0]}, Vector{-1, 0, slope_x_ + shift_[0]},
          Vector{0, 1, slope_y_ - shift_[1]}, Vector{0, -1, slope_y_ + shift_[1]}}) {
      if (result.empty()) break;
      result = clipped(result, inward, 0);
    }
    return result;
  }
  PixelPoint pixel(const Vector& seen) const {
    return {centre_[0] + scale_ * seen[0] / seen[2], centre_[1] - scale_ * seen[1] / seen[2]};
  }
  std::vector<PixelPoint> pixels(const std::vector<Vector>& loop) const {
    std::vector<PixelPoint> result;
    for (const Vector& seen : visible(loop)) result.push_back(pixel(seen));
    return result;
  }
  /// Nothing if the point is not in view.
  std::optional<PixelPoint> pixel_of(const Vector& point) const {
    const Vector d = point - eye_;
    const Vector seen{dot(d, right_), dot(d, up_), dot(d, forward_)};
    if (seen[2] < near_ || std::abs(seen[0] - shift_[0] * seen[2]) > slope_x_ * seen[2] ||
        std::abs(seen[1] - shift_[1] * seen[2]) > slope_y_ * seen[2]) {
      return std::nullopt;
    }
    return pixel(seen);
  }
  /// Back from the camera's axes to the scene.
  Vector scene_point(const Vector& seen) const {
    return eye_ + seen[0] * right_ + seen[1] * up_ + seen[2] * forward_;
  }
  const Vector& eye() const { return eye_; }

 private:
  /// Chooses the scale (pixels a unit at distance 1) if none is set, and the middle of the frame if
  /// asked, so that all of the scene is in view; 75 degrees from where that cannot be.
  void frame(const std::vector<Vector>& scene, double width, double height, bool centre_scene) {
    constexpr double kMargin = 0.93, kWidest = 0.77;  // tangent of half of 75 degrees
    const double least = std::max(width, height) / 2 / kWidest;
    PixelPoint low{0, 0}, high{0, 0};
    bool first = true, all_in_front = true;
    for (const Vector& point : scene) {
      const Vector d = point - eye_;
      const double depth = dot(d, forward_);
      all_in_front = all_in_front && depth > 0;
      if (!all_in_front) break;
      const PixelPoint seen{dot(d, right_) / depth, dot(d, up_) / depth};
      for (int k = 0; k < 2; ++k) {
        low[k] = first ? seen[k] : std::min(low[k], seen[k]);
        high[k] = first ? seen[k] : std::max(high[k], seen[k]);
      }
      first = false;
    }
    if (!all_in_front || first) {
      if (scale_ <= 0) scale_ = least;
      return;
    }
    PixelPoint reach{};
    PixelPoint middle{};
    for (int k = 0; k < 2; ++k) {
      middle[k] = centre_scene ? (low[k] + high[k]) / 2 : 0;
      reach[k] = std::max({high[k] - middle[k], middle[k] - low[k], 1e-12});
    }
    if (scale_ <= 0) {
      scale_ = std::max(least, kMargin * std::min(width / 2 / reach[0], height / 2 / reach[1]));
    }
    centre_[0] -= scale_ * middle[0];
    centre_[1] += scale_ * middle[1];
    shift_ = middle;
  }

  Vector eye_, forward_, right_, up_;
  PixelPoint centre_;       // of the eye's axis, in pixels
  PixelPoint shift_{0, 0};  // of the frame's middle from it, as a slope
  double scale_, slope_x_, slope_y_, near_;
};

inline std::pair<Vector, Vector> bounding_box(const PreparedScene& prepared) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vector low{kInfinity, kInfinity, kInfinity}, high = -1.0 * low;
  for (VertexId vertex : prepared.loop_vertices) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], prepared.geometry.positions[vertex][k]);
      high[k] = std::max(high[k], prepared.geometry.positions[vertex][k]);
    }
  }
  if (prepared.loop_vertices.empty()) return {Vector{}, Vector{}};
  return {low, high};
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PICTURES_VIEW_H
