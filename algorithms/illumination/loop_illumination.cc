// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/loop_illumination.h"

#include <algorithm>
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
  // What is received does not depend on the unit of length, and products of lengths may overflow or
  // underflow: the farthest vertex is about 1 away.
  double farthest = 0;
  for (const Vector& vertex : loop) {
    const Vector a = minus(vertex, point);
    farthest = std::max(farthest, std::hypot(a[0], a[1], a[2]));
  }
  if (farthest == 0) return 0;
  const int exponent = -std::ilogb(farthest);
  const auto scaled = [exponent](const Vector& a) -> Vector {
    return {std::scalbn(a[0], exponent), std::scalbn(a[1], exponent), std::scalbn(a[2], exponent)};
  };
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector &from = loop[i], &to = loop[i + 1 == loop.size() ? 0 : i + 1];
    const Vector a = scaled(minus(from, point));
    // a x b by the edge itself, since a and b of a far light are nearly equal.
    const Vector across = cross(a, scaled(minus(to, from)));
    const double sine = std::hypot(across[0], across[1], across[2]);
    const double cosine = dot(a, scaled(minus(to, point)));
    if (sine == 0 && cosine == 0) continue;
    sum -= angle_over_sine(sine, cosine) * dot(normal, across);
  }
  return sum / 2;
}

}  // namespace gnomon
