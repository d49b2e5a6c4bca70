// SPDX-License-Identifier: LGPL-3.0-or-later
// Image space of the kernel `epick`: points in doubles, the point of a sample rounded, and exact
// predicates on them.
#ifndef GNOMON_KERNEL_CGAL_EPICK_IMAGE_SPACE_H
#define GNOMON_KERNEL_CGAL_EPICK_IMAGE_SPACE_H

#include <array>

#include "kernel/cgal/epick_predicates.h"
#include "kernel/concept/constructed_image_space.h"

namespace gnomon {

class EpickImageArithmetic {
 public:
  using Number = double;
  using Vector = std::array<double, 3>;
  /// Rounded coefficients, and the points that they are of.
  struct Plane {
    Vector n;
    double d;
    EpickPlane points;
  };
  static constexpr bool kExact = false;

  EpickImageArithmetic(const Geometry& geometry, const KernelOptions&) : geometry_(&geometry) {}

  Vector vertex(VertexId v) const { return geometry_->positions[v]; }
  Vector point(const LightPoint& light) const { return light.nearest; }
  /// Of rational numbers on the grid, or of doubles.
  Vector position(const std::array<mpq_class, 3>& grid) const {
    Vector result;
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = mpq_class(geometry_->origin[k] + geometry_->step * grid[k]).get_d();
    }
    return result;
  }
  Vector position(const std::array<double, 3>& grid) const {
    Vector result;
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = geometry_->origin[k].get_d() + geometry_->step.get_d() * grid[k];
    }
    return result;
  }
  double number(std::int64_t value) const { return static_cast<double>(value); }
  Plane plane_through(const Vector& a, const Vector& b, const Vector& c) const {
    return plane_of({EpickPlane::Kind::kPoints, a, b, c, nullptr});
  }
  Plane plane_along(const Vector& a, const Vector& direction, const Vector& c) const {
    return plane_of({EpickPlane::Kind::kDirection, a, direction, c, nullptr});
  }
  Sign side(const Plane& plane, const Vector& x) const {
    return static_cast<Sign>(epick_detail::side_of_points(plane.points, x));
  }
  /// Exact for the rounded points.
  Sign along(const Plane& plane, const Vector& d) const {
    const EpickPlane& of = plane.points;
    const auto exact_sign = [&]<class Number>(const auto& number) {
      std::array<Number, 3> r, s, t;
      for (std::size_t k = 0; k < 3; ++k) {
        r[k] = of.kind == EpickPlane::Kind::kPoints ? Number(number(of.b[k]) - number(of.a[k]))
                                                    : number(of.b[k]);
        s[k] = Number(number(of.c[k]) - number(of.a[k]));
        t[k] = number(d[k]);
      }
      return epick_detail::determinant(r, s, t);
    };
    const Ball value = exact_sign.template operator()<Ball>([](double x) { return Ball(x); });
    if (value.is_finite()) {
      if (value.lower() > 0) return Sign::kPositive;
      if (value.upper() < 0) return Sign::kNegative;
    }
    return static_cast<Sign>(
        sgn(exact_sign.template operator()<mpq_class>([](double x) { return mpq_class(x); })));
  }
  Sign side_of_direction(const Plane& plane, const Vector& d) const { return along(plane, d); }
  static double to_double(double value) { return value; }

 private:
  static Plane plane_of(const EpickPlane& points) {
    const epick_detail::Epick::Plane_3 made = epick_detail::coefficients(points);
    return {{made.a(), made.b(), made.c()}, -made.d(), points};
  }

  const Geometry* geometry_;
};

using EpickImageSpace = ConstructedImageSpace<EpickImageArithmetic>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPICK_IMAGE_SPACE_H
