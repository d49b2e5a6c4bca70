// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes of the polygons in charts of the light's directions, for the search for pairs, and ranges
// of their depths.
//
// A sun has one chart, and a far lamp another like it. Any other lamp has one where all polygons
// are in front of some plane through it: the directions r with m . r > 0 at (r . a, r . b) / (m .
// r). Else it has the six faces of a cube around it, and a polygon a box in each face that it
// reaches.
//
// Guarantee: a box holds its polygon's directions (all of the face, in a face); ranges hold its
// depths. Polygons whose boxes overlap in no chart do not overlap as seen from the light. Of
// rounded kernels, as their numbers say.
#ifndef GNOMON_ALGORITHMS_CONTOUR_LIGHT_CHARTS_H
#define GNOMON_ALGORITHMS_CONTOUR_LIGHT_CHARTS_H

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/contour/chart_boxes.h"
#include "algorithms/contour/facing_polygons.h"
#include "algorithms/partition/chart_box.h"
#include "algorithms/partition/in_parallel.h"

namespace gnomon {

/// A direction in doubles.
using Direction = std::array<double, 3>;

/// Boxes of one chart, in memory that is kept.
struct BoxArrays {
  std::vector<float> low_u, low_v, high_u, high_v;
  std::vector<std::uint32_t> owners;

  void resize(std::size_t size) {
    for (auto* array : {&low_u, &low_v, &high_u, &high_v}) array->resize(size);
  }
  void clear() {
    resize(0);
    owners.clear();
  }
  void push(const std::array<double, 4>& box, std::uint32_t owner);
  ChartBoxes view() const { return {low_u, low_v, high_u, high_v, owners}; }
};

class LightCharts {
 public:
  template <class Numbers>
  void find(const FacingPolygons<Numbers>& polygons, const LightRays<Numbers>& light,
            unsigned jobs);

  std::span<const ChartBoxes> charts() const { return charts_; }
  std::span<const DepthRange> depths() const { return depths_; }
  /// Whether there is one chart, in which box i is that of polygon i.
  bool is_one() const { return charts_.size() == 1; }
  /// Where a direction is in the one chart. Requires: is_one().
  std::array<float, 2> place(const Direction& ray) const {
    if (directional_) return {static_cast<float>(ray[0]), static_cast<float>(ray[1])};
    if (of_heights_) {
      const double z = 1 / std::fabs(ray[2]);
      return {static_cast<float>(ray[0] * z), static_cast<float>(ray[1] * z)};
    }
    const double z = 1 / dot_product(frame_.w, ray);
    return {static_cast<float>(dot_product(frame_.u, ray) * z),
            static_cast<float>(dot_product(frame_.v, ray) * z)};
  }

 private:
  /// A chart of all directions in front of a plane.
  struct Frame {
    Direction u, v, w;
  };
  template <class Numbers>
  bool choose_frame(const FacingPolygons<Numbers>& polygons, Frame& frame) const;
  template <class Numbers>
  bool fill_one_chart(const FacingPolygons<Numbers>& polygons, const LightRays<Numbers>& light,
                      const Frame& frame, unsigned jobs);
  /// Adds the boxes of a polygon in the faces of the cube.
  void add_to_faces(std::span<const Direction> corners, std::uint32_t owner);

  bool directional_ = false, of_heights_ = false;
  Frame frame_{};  // of a lamp's one chart
  BoxArrays one_;
  std::array<BoxArrays, 6> faces_;
  std::vector<ChartBoxes> charts_;
  std::vector<DepthRange> depths_;
  std::vector<Direction> loop_, clipped_, loop_work_;
};

/// The direction of a ray in doubles; infinite where it has none.
template <class T>
Direction direction_of(const Vector<T>& ray) {
  if constexpr (std::is_same_v<T, mpq_class>) {
    return {ray[0].get_d(), ray[1].get_d(), ray[2].get_d()};
  } else {
    return {static_cast<double>(ray[0]), static_cast<double>(ray[1]), static_cast<double>(ray[2])};
  }
}

/// A direction around which all polygons may lie: the mean of a sample of corners.
template <class Numbers>
bool LightCharts::choose_frame(const FacingPolygons<Numbers>& polygons, Frame& frame) const {
  constexpr std::uint32_t kSample = 1024;
  Direction mean{0, 0, 0};
  const std::uint32_t stride = 1 + polygons.size() / kSample;
  for (std::uint32_t i = 0; i < polygons.size(); i += stride) {
    const Direction r = direction_of(polygons.corner(polygons.polygons[i], 0));
    const double size = std::sqrt(dot_product(r, r));
    for (int k = 0; k < 3; ++k) mean[k] += r[k] / size;
  }
  const double size = std::sqrt(dot_product(mean, mean));
  if (!(size > 0) || !(size < std::numeric_limits<double>::infinity())) return false;
  for (double& x : mean) x /= size;
  // The axis that is farthest from it gives a second direction.
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(mean[k]) < std::fabs(mean[axis])) axis = k;
  }
  Direction other{0, 0, 0};
  other[axis] = 1;
  frame.w = mean;
  frame.u = cross_product(mean, other);
  const double length = std::sqrt(dot_product(frame.u, frame.u));
  for (double& x : frame.u) x /= length;
  frame.v = cross_product(mean, frame.u);
  return true;
}

// With m . r > kLeastCosine |r| quotients are at most 1 / kLeastCosine, and off by less than 10u /
// kLeastCosine^2; those of a sun, rays of at most `most`, by 2u most. Depths of a lamp are 1 / (m .
// r) at the corners.
template <class Numbers>
bool LightCharts::fill_one_chart(const FacingPolygons<Numbers>& polygons,
                                 const LightRays<Numbers>& light, const Frame& frame,
                                 unsigned jobs) {
  constexpr double kLeastCosine = 0.1;
  one_.resize(polygons.size());
  std::atomic<bool> all = true;
  in_parallel(jobs, polygons.size(), 1024, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const FacingPolygon& p = polygons.polygons[i];
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      double low_u = kInfinity, low_v = kInfinity, high_u = -kInfinity, high_v = -kInfinity;
      double low_z = kInfinity, high_z = -kInfinity, most = 0, least_third = kInfinity;
      const Direction depth = direction_of(light.depths[p.plane]);
      for (std::uint32_t k = 0; k < p.count; ++k) {
        const Direction r = direction_of(polygons.corner(p, k));
        double u, v, z;
        if (light.directional) {
          u = r[0];
          v = r[1];
          z = dot_product(depth, r);
          most = std::fabs(r[2]);  // the same of all corners
        } else if (light.of_heights) {
          // As of a sun, but for a quotient: off by 11u / |r_z| of what |r_z| >= 1/4 leaves.
          const double inverse = 1 / std::fabs(r[2]);
          u = r[0] * inverse;
          v = r[1] * inverse;
          z = dot_product(depth, r) * inverse;
          most = 1;
          least_third = std::min(least_third, std::fabs(r[2]));
        } else {
          const double w = dot_product(frame.w, r);
          const double size = std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]);
          if (!(w > kLeastCosine * size)) {
            all.store(false, std::memory_order_relaxed);
            return;
          }
          z = 1 / w;
          u = dot_product(frame.u, r) * z;
          v = dot_product(frame.v, r) * z;
          most = 1;
        }
        low_u = std::min(low_u, u);
        high_u = std::max(high_u, u);
        low_v = std::min(low_v, v);
        high_v = std::max(high_v, v);
        low_z = std::min(low_z, z);
        high_z = std::max(high_z, z);
      }
      if (light.of_heights) {
        most = std::max(
            {most, std::fabs(low_u), std::fabs(high_u), std::fabs(low_v), std::fabs(high_v)});
      }
      const double margin = 0x1p-40 * most;
      if (!(margin < kInfinity) || !(high_u - low_u < kInfinity) || !(high_v - low_v < kInfinity)) {
        low_u = low_v = -kInfinity;
        high_u = high_v = kInfinity;
      }
      one_.low_u[i] = float_below(low_u - margin);
      one_.low_v[i] = float_below(low_v - margin);
      one_.high_u[i] = float_above(high_u + margin);
      one_.high_v[i] = float_above(high_v + margin);
      double z_margin = 0;
      if (light.directional) {
        z_margin = Numbers::kCertified ? light.depth_error[p.plane] * polygons.reach[i]
                                       : 0x1p-47 * most * largest(depth);
      } else if (light.of_heights) {
        z_margin = Numbers::kCertified
                       ? 1.1 * light.depth_error[p.plane] * polygons.reach[i] / least_third
                       : 0x1p-45 * most * largest(depth);
        z_margin += 0x1p-50 * std::max(std::fabs(low_z), std::fabs(high_z));
      }
      if (high_z - low_z + z_margin < kInfinity) {
        depths_[i] = {float_below(low_z - z_margin), float_above(high_z + z_margin)};
      }
    }
  });
  return all;
}

template <class Numbers>
void LightCharts::find(const FacingPolygons<Numbers>& polygons, const LightRays<Numbers>& light,
                       unsigned jobs) {
  depths_.assign(polygons.size(), {});
  charts_.clear();
  directional_ = light.directional;
  of_heights_ = light.of_heights;
  if ((light.of_heights || choose_frame(polygons, frame_)) &&
      fill_one_chart(polygons, light, frame_, jobs)) {
    charts_.push_back(one_.view());
    return;
  }
  depths_.assign(polygons.size(), {});
  for (BoxArrays& face : faces_) face.clear();
  for (std::uint32_t i = 0; i < polygons.size(); ++i) {
    const FacingPolygon& p = polygons.polygons[i];
    loop_.clear();
    for (std::uint32_t k = 0; k < p.count; ++k) {
      loop_.push_back(direction_of(polygons.corner(p, k)));
    }
    add_to_faces(loop_, i);
  }
  for (const BoxArrays& face : faces_) charts_.push_back(face.view());
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_LIGHT_CHARTS_H
