// SPDX-License-Identifier: LGPL-3.0-or-later
// Image space of the kernel `epeck`: CGAL's lazy numbers, positions in grid units.
#ifndef GNOMON_KERNEL_CGAL_EPECK_IMAGE_SPACE_H
#define GNOMON_KERNEL_CGAL_EPECK_IMAGE_SPACE_H

#include <array>

#include "kernel/cgal/epeck_numbers.h"
#include "kernel/concept/constructed_image_space.h"

namespace gnomon {

class EpeckImageArithmetic {
 public:
  using Number = Epeck::FT;
  using Vector = std::array<Number, 3>;
  struct Plane {
    Vector n;
    Number d;
  };
  static constexpr bool kExact = true;

  EpeckImageArithmetic(const Geometry& geometry, const KernelOptions&) : geometry_(&geometry) {}

  Vector vertex(VertexId v) const {
    const GridPositions& grid = geometry_->grid;
    return numbers({grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)});
  }
  Vector point(const LightPoint& light) const { return numbers(light.grid); }
  Vector position(const std::array<mpq_class, 3>& grid) const {
    const auto number = [](const mpq_class& x) {
      Number result = epeck_detail::number_from(x.get_num());
      if (x.get_den() != 1) result /= epeck_detail::number_from(x.get_den());
      result.exact();  // a leaf of all later expressions
      return result;
    };
    return {number(grid[0]), number(grid[1]), number(grid[2])};
  }
  Number number(std::int64_t value) const { return Number(static_cast<double>(value)); }
  Plane plane_through(const Vector& a, const Vector& b, const Vector& c) const {
    return plane_along(a, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, c);
  }
  Plane plane_along(const Vector& a, const Vector& r, const Vector& c) const {
    const Vector s = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    Plane plane{{r[1] * s[2] - r[2] * s[1], r[2] * s[0] - r[0] * s[2], r[0] * s[1] - r[1] * s[0]},
                Number(0)};
    for (Number& n : plane.n) n.exact();  // leaves of all later expressions
    plane.d = dot(plane.n, a);
    plane.d.exact();
    return plane;
  }
  Sign side(const Plane& plane, const Vector& x) const { return sign(dot(plane.n, x) - plane.d); }
  Sign along(const Plane& plane, const Vector& d) const { return sign(dot(plane.n, d)); }
  Sign side_of_direction(const Plane& plane, const Vector& d) const { return along(plane, d); }
  static double to_double(const Number& value) { return CGAL::to_double(value); }

 private:
  static Vector numbers(const std::array<mpz_class, 3>& v) {
    return {epeck_detail::number_from(v[0]), epeck_detail::number_from(v[1]),
            epeck_detail::number_from(v[2])};
  }
  static Number dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Sign sign(const Number& value) {
    return static_cast<Sign>(static_cast<int>(CGAL::sign(value)));
  }

  const Geometry* geometry_;
};

using EpeckImageSpace = ConstructedImageSpace<EpeckImageArithmetic>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPECK_IMAGE_SPACE_H
