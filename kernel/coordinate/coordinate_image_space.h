// SPDX-License-Identifier: LGPL-3.0-or-later
// Image space of the kernels whose numbers are float, double, long double or GMP rationals:
// positions in scene units.
#ifndef GNOMON_KERNEL_COORDINATE_COORDINATE_IMAGE_SPACE_H
#define GNOMON_KERNEL_COORDINATE_COORDINATE_IMAGE_SPACE_H

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <type_traits>

#include "kernel/concept/constructed_image_space.h"
#include "kernel/coordinate/coordinate_space.h"

namespace gnomon {

template <class T>
class CoordinateImageArithmetic {
 public:
  using Number = T;
  using Vector = std::array<T, 3>;
  using Plane = CoordinatePlane<T>;
  static constexpr bool kExact = CoordinatePlanes<T>::kExact;

  CoordinateImageArithmetic(const Geometry& geometry, const KernelOptions& options)
      : geometry_(&geometry), planes_(geometry, options) {}

  Vector vertex(VertexId v) const { return planes_.input_vertex(v).x; }
  Vector point(const LightPoint& light) const {
    Vector result;
    for (std::size_t k = 0; k < 3; ++k) {
      if constexpr (kExact) {
        result[k] = light.directional
                        ? mpq_class(light.grid[k])
                        : mpq_class(geometry_->origin[k] + geometry_->step * light.grid[k]);
      } else {
        result[k] = static_cast<T>(light.nearest[k]);
      }
    }
    return result;
  }
  /// Of rational numbers on the grid, or of doubles.
  template <class Coordinate>
  Vector position(const std::array<Coordinate, 3>& grid) const {
    Vector result;
    for (std::size_t k = 0; k < 3; ++k) {
      if constexpr (std::is_same_v<Coordinate, double>) {
        result[k] =
            static_cast<T>(geometry_->origin[k].get_d() + geometry_->step.get_d() * grid[k]);
      } else {
        const mpq_class x = geometry_->origin[k] + geometry_->step * grid[k];
        if constexpr (kExact) {
          result[k] = x;
        } else {
          result[k] = static_cast<T>(x.get_d());
        }
      }
    }
    return result;
  }
  T number(std::int64_t value) const {
    if constexpr (kExact) {
      return mpq_class(static_cast<long>(value));
    } else {
      return static_cast<T>(value);
    }
  }
  Plane plane_through(const Vector& a, const Vector& b, const Vector& c) const {
    return planes_.plane_through({a}, {b}, {c});
  }
  Plane plane_along(const Vector& a, const Vector& direction, const Vector& c) const {
    const Vector s = {T(c[0] - a[0]), T(c[1] - a[1]), T(c[2] - a[2])};
    const auto component = [&](std::size_t i, std::size_t j) {
      return T(direction[i] * s[j] - direction[j] * s[i]);
    };
    return planes_.plane_from({component(1, 2), component(2, 0), component(0, 1)}, a);
  }
  Sign side(const Plane& plane, const Vector& x) const {
    return static_cast<Sign>(planes_.side(plane, {x}));
  }
  Sign along(const Plane& plane, const Vector& d) const {
    return sign_of(T(plane.n[0] * d[0] + plane.n[1] * d[1] + plane.n[2] * d[2]));
  }
  /// The thickness of a plane of the scene's size, as an angle.
  Sign side_of_direction(const Plane& plane, const Vector& d) const {
    if constexpr (kExact) {
      return along(plane, d);
    } else {
      const T value = plane.n[0] * d[0] + plane.n[1] * d[1] + plane.n[2] * d[2];
      const T thickness = planes_.relative_thickness() * std::hypot(d[0], d[1], d[2]);
      return value > thickness    ? Sign::kPositive
             : value < -thickness ? Sign::kNegative
                                  : Sign::kZero;
    }
  }
  static double to_double(const T& value) {
    if constexpr (kExact) {
      return value.get_d();
    } else {
      return static_cast<double>(value);
    }
  }

 private:
  const Geometry* geometry_;
  CoordinatePlanes<T> planes_;
};

template <class T>
using CoordinateImageSpace = ConstructedImageSpace<CoordinateImageArithmetic<T>>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_COORDINATE_COORDINATE_IMAGE_SPACE_H
