// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/loop_illumination.h"

#include <cmath>
#include <cstddef>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

using Vector = std::array<double, 3>;

/// angle / sine of the angle between two vectors, where `sine` and `cosine` carry their lengths:
/// the limit where the sine vanishes.
double angle_over_sine(double sine, double cosine) {
  return sine > 0 ? std::atan2(sine, cosine) / sine : 1 / cosine;
}

}  // namespace

double loop_illumination(std::span<const Vector> loop, const Vector& point, const Vector& normal) {
  if (loop.size() < 3) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector &from = loop[i], &to = loop[i + 1 == loop.size() ? 0 : i + 1];
    const Vector a = minus(from, point);
    // a x b by the edge itself, since a and b of a far light are nearly equal.
    const Vector across = cross(a, minus(to, from));
    const double sine = std::hypot(across[0], across[1], across[2]);
    const double cosine = dot(a, minus(to, point));
    if (sine == 0 && cosine == 0) continue;
    sum -= angle_over_sine(sine, cosine) * dot(normal, across);
  }
  return sum / 2;
}

}  // namespace gnomon
