// SPDX-License-Identifier: LGPL-3.0-or-later
// Points of a prepared scene in scene units, but counted from the corner of its box, so that they
// are as good far from the origin as near it.
#ifndef GNOMON_SCENE_INTENT_LOCAL_POINTS_H
#define GNOMON_SCENE_INTENT_LOCAL_POINTS_H

#include <array>
#include <cmath>
#include <span>

#include "gnomon/scene/prepare.h"

namespace gnomon::scene_detail {

struct Vector {
  long double x = 0, y = 0, z = 0;

  friend Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector operator*(long double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
  long double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline long double dot_of(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector cross_of(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline long double length_of(const Vector& a) { return std::sqrt(dot_of(a, a)); }

class LocalPoints {
 public:
  explicit LocalPoints(const PreparedScene& scene)
      : scene_(scene), step_(static_cast<long double>(scene.geometry.step.get_d())) {}

  Vector operator[](VertexId vertex) const {
    const GridPositions& grid = scene_.geometry.grid;
    if (grid.is_narrow()) {
      const std::int64_t* const p = grid.narrow_point(vertex);
      return {step_ * static_cast<long double>(p[0]), step_ * static_cast<long double>(p[1]),
              step_ * static_cast<long double>(p[2])};
    }
    const auto at = [&](int axis) {
      return static_cast<long double>(
          mpq_class(scene_.geometry.step * grid.wide(vertex, axis)).get_d());
    };
    return {at(0), at(1), at(2)};
  }
  /// A position of a light, that is on the same grid.
  Vector of_grid(const std::array<mpz_class, 3>& point) const {
    const auto at = [&](int axis) {
      return static_cast<long double>(
          mpq_class(scene_.geometry.step * point[static_cast<std::size_t>(axis)]).get_d());
    };
    return {at(0), at(1), at(2)};
  }

  /// Twice the area vector of a part.
  Vector area_vector(std::span<const VertexId> loop) const {
    Vector sum;
    const Vector first = (*this)[loop[0]];
    Vector last = (*this)[loop[1]] - first;
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Vector next = (*this)[loop[i]] - first;
      sum = sum + cross_of(last, next);
      last = next;
    }
    return sum;
  }

 private:
  const PreparedScene& scene_;
  long double step_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_INTENT_LOCAL_POINTS_H
