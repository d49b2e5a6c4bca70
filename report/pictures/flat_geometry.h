// SPDX-License-Identifier: GPL-3.0-or-later
// Convex loops in doubles for pictures: clipping and projection, good to a pixel and no more.
#ifndef GNOMON_REPORT_PICTURES_FLAT_GEOMETRY_H
#define GNOMON_REPORT_PICTURES_FLAT_GEOMETRY_H

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scene/base/vectors.h"

namespace gnomon::report {

using Vector = std::array<double, 3>;

inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }
/// The zero vector stays zero.
inline Vector unit(const Vector& a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : a;
}

/// The area vector (twice the area, in the direction of the front).
inline Vector area_vector(const std::vector<Vector>& loop) {
  Vector sum{};
  for (std::size_t i = 2; i < loop.size(); ++i) {
    sum = sum + cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  }
  return sum;
}

/// The part of a convex loop where normal . x >= offset.
inline std::vector<Vector> clipped(const std::vector<Vector>& loop, const Vector& normal,
                                   double offset) {
  std::vector<Vector> result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector& a = loop[i];
    const Vector& b = loop[(i + 1) % loop.size()];
    const double at_a = dot(normal, a) - offset, at_b = dot(normal, b) - offset;
    if (at_a >= 0) result.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
      result.push_back(a + (at_a / (at_a - at_b)) * (b - a));
    }
  }
  if (result.size() < 3) result.clear();
  return result;
}

/// A loop moved along the unit normal into the plane through a point.
inline std::vector<Vector> projected(std::vector<Vector> loop, const Vector& normal,
                                     const Vector& point) {
  for (Vector& vertex : loop) vertex = vertex - dot(normal, vertex - point) * normal;
  return loop;
}

/// The part of a loop inside a convex one of the same plane, whatever their orientation.
inline std::vector<Vector> intersection(std::vector<Vector> loop,
                                        const std::vector<Vector>& other) {
  const Vector normal = area_vector(other);
  for (std::size_t i = 0; i < other.size() && !loop.empty(); ++i) {
    const Vector& a = other[i];
    const Vector inward = unit(cross(normal, other[(i + 1) % other.size()] - a));
    if (length(inward) == 0) continue;
    loop = clipped(loop, inward, dot(inward, a));
  }
  return loop;
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PICTURES_FLAT_GEOMETRY_H
