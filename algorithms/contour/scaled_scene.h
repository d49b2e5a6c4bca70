// SPDX-License-Identifier: LGPL-3.0-or-later
// Positions and a light in the numbers of a kernel that is rounded or rational, scaled for the
// contour method (light_rays.h).
#ifndef GNOMON_ALGORITHMS_CONTOUR_SCALED_SCENE_H
#define GNOMON_ALGORITHMS_CONTOUR_SCALED_SCENE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "algorithms/contour/numbers.h"
#include "gnomon/kernel/geometry.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon::contour_detail {

/// Positions and the light in a kernel's own numbers: rationals on the grid, or rounded and scaled
/// by a power of two to a size of 1, so that products of three of them neither over- nor underflow.
/// A far lamp is scaled by itself, and both are seen from the corner of the grid.
template <class T>
class ScaledScene {
 public:
  ScaledScene(const Geometry& geometry, const LightPoint& light, bool far) : geometry_(geometry) {
    if constexpr (!std::is_same_v<T, mpq_class>) {
      for (int k = 0; far && k < 3; ++k) {
        corner_[k] = geometry.origin[static_cast<std::size_t>(k)].get_d();
      }
      double most = 0, most_of_light = 0;
      for (const std::array<double, 3>& p : geometry.positions) {
        most = std::max(most, largest({p[0] - corner_[0], p[1] - corner_[1], p[2] - corner_[2]}));
      }
      const std::array<double, 3>& l = light.nearest;
      most_of_light = largest({l[0] - corner_[0], l[1] - corner_[1], l[2] - corner_[2]});
      if (!light.directional && !far) most = most_of_light = std::max(most, most_of_light);
      scale_ = power_below(most);
      light_scale_ = power_below(most_of_light);
      nearness_ = far ? T(light_scale_ / scale_) : T(0);
    } else if (far) {
      // Rays are to be doubles for boxes, however far it is.
      mpq_div_2exp(nearness_.get_mpq_t(), mpq_class(1).get_mpq_t(), bits_of(light.grid));
    }
    for (int k = 0; k < 3; ++k) {
      if constexpr (std::is_same_v<T, mpq_class>) {
        light_[k] = light.grid[k];
        if (far) light_[k] *= nearness_;
      } else {
        light_[k] = static_cast<T>((light.nearest[k] - corner_[k]) * light_scale_);
      }
    }
  }
  Vector<T> position(VertexId v) const {
    Vector<T> p;
    for (int k = 0; k < 3; ++k) {
      if constexpr (std::is_same_v<T, mpq_class>) {
        p[k] = geometry_.grid.at(v, k);
      } else {
        p[k] = static_cast<T>((geometry_.positions[v][k] - corner_[k]) * scale_);
      }
    }
    return p;
  }
  const Vector<T>& light() const { return light_; }
  double scale() const { return scale_; }
  /// Of z in the third component of a ray: 0 but for a far lamp.
  const T& nearness() const { return nearness_; }

 private:
  static double power_below(double size) {
    return size > 0x1p-900 && size < 0x1p900 ? std::ldexp(1.0, -std::ilogb(size)) : 1;
  }
  const Geometry& geometry_;
  std::array<double, 3> corner_{};
  double scale_ = 1, light_scale_ = 1;
  T nearness_{};
  Vector<T> light_;
};

}  // namespace gnomon::contour_detail

#endif  // GNOMON_ALGORITHMS_CONTOUR_SCALED_SCENE_H
