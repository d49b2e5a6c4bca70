// SPDX-License-Identifier: LGPL-3.0-or-later
// What the spaces of the kernel `epeck` ask of CGAL's lazy numbers: exact from integers, to
// rationals, enclosed; sides and crossings, exact.
#ifndef GNOMON_KERNEL_CGAL_EPECK_NUMBERS_H
#define GNOMON_KERNEL_CGAL_EPECK_NUMBERS_H

#include <cmath>
#include <utility>
#include <vector>

#include "kernel/cgal/epeck_space.h"

namespace gnomon::epeck_detail {

using Number = Epeck::FT;

/// Any integer, exactly: 52 bits at a time, evaluated at once so that it is a leaf of later
/// expressions.
inline Number number_from(const mpz_class& value) {
  if (mpz_sizeinbase(value.get_mpz_t(), 2) <= 53) return Number(value.get_d());
  Number result(0);
  const Number radix(0x1p52);
  mpz_class rest = abs(value);
  std::vector<double> digits;
  while (rest != 0) {
    const mpz_class digit = rest & ((mpz_class(1) << 52) - 1);
    digits.push_back(digit.get_d());
    rest >>= 52;
  }
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit) {
    result = result * radix + Number(*digit);
  }
  if (sgn(value) < 0) result = -result;
  result.exact();
  return result;
}

/// Whatever rational type CGAL was built with.
template <class Rational>
mpq_class to_mpq(const Rational& value) {
  if constexpr (requires { mpq_class(value.mpq()); }) {
    return mpq_class(value.mpq());
  } else if constexpr (requires { mpq_class(value.backend().data()); }) {
    return mpq_class(value.backend().data());
  } else {
    return mpq_class(value);
  }
}

inline Ball enclose(const Number& value) {
  const std::pair<double, double> bounds = CGAL::to_interval(value);
  const double middle = bounds.first + (bounds.second - bounds.first) / 2;
  const double radius = std::fmax(bounds.second - middle, middle - bounds.first);
  return {middle, std::nextafter(radius, INFINITY)};
}

inline EpeckVertex meeting_point(const Epeck::Plane_3& plane, const Epeck::Point_3& from,
                                 const Epeck::Point_3& to) {
  const auto result = CGAL::intersection(plane, Epeck::Line_3(from, to));
  // The two points lie strictly on different sides, decided exactly: they meet in one point.
  return {boost::get<Epeck::Point_3>(*result), kMadeVertex};
}

inline Side side_of(const Epeck::Plane_3& plane, const Epeck::Point_3& point) {
  return static_cast<Side>(static_cast<int>(plane.oriented_side(point)));
}

/// Scene units.
inline std::array<mpq_class, 3> exact_point(const Geometry& geometry, const Epeck::Point_3& x) {
  std::array<mpq_class, 3> point;
  for (int k = 0; k < 3; ++k) {
    point[k] = geometry.origin[k] + geometry.step * to_mpq(x[k].exact());
  }
  return point;
}

}  // namespace gnomon::epeck_detail

#endif  // GNOMON_KERNEL_CGAL_EPECK_NUMBERS_H
