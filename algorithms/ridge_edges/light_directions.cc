// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/ridge_edges/light_directions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

/// Of the sun: the coordinates across the largest one of its direction, sheared along it.
class SunChart {
 public:
  explicit SunChart(const DirectionVector& to_light) : to_light_(to_light) {
    for (int k = 1; k < 3; ++k) {
      if (abs(to_light[k]) > abs(to_light[axis_])) axis_ = k;
    }
  }
  DirectionVector of(const DirectionVector& point) const {
    const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    DirectionVector result{across(point, u), across(point, v), 1};
    // The chart is seen from its other side where the light comes from below.
    if (to_light_[axis_] < 0) result[0] = -result[0];
    return result;
  }

 private:
  mpz_class across(const DirectionVector& point, int k) const {
    return point[k] * to_light_[axis_] - point[axis_] * to_light_[k];
  }

  const DirectionVector& to_light_;
  int axis_ = 0;
};

}  // namespace

FilteredVector::FilteredVector(DirectionVector vector) : exact(std::move(vector)) {
  // All by one power of two, so that nothing overflows and nothing large is lost.
  std::size_t bits = 0;
  for (const mpz_class& c : exact) {
    if (c != 0) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, exact[k].get_mpz_t());
    nearest[k] = std::ldexp(mantissa,
                            static_cast<int>(std::max(exponent - static_cast<long>(bits), -1000L)));
  }
  const double length = std::hypot(nearest[0], nearest[1], nearest[2]);
  if (length == 0) return;
  for (double& c : nearest) c /= length;
}

Sign side(const FilteredVector& a, const FilteredVector& b) {
  // Either factor of a product is off by 4u at most and no more than 1, so that each is off by 9u,
  // with its rounding, and the sum of three, with its own, by less than 32u.
  constexpr double kBound = 32 * 0x1p-53;
  const double value = dot(a.nearest, b.nearest);
  if (value > kBound) return Sign::kPositive;
  if (value < -kBound) return Sign::kNegative;
  return sign_of(mpz_class(dot(a.exact, b.exact)));
}

DirectionVector primitive(DirectionVector vector) {
  mpz_class divisor = gcd(gcd(vector[0], vector[1]), vector[2]);
  if (divisor != 1) {
    for (mpz_class& c : vector) {
      mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), divisor.get_mpz_t());
    }
  }
  return vector;
}

LightDirections::LightDirections(const Geometry& geometry, const LightPoint& light) {
  std::vector<DirectionVector> all;
  all.reserve(geometry.positions.size());
  const SunChart chart(light.grid);
  std::size_t bits = 0;
  for (VertexId vertex = 0; vertex < geometry.positions.size(); ++vertex) {
    const DirectionVector point{geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1),
                                geometry.grid.at(vertex, 2)};
    all.push_back(light.directional ? chart.of(point) : minus(light.grid, point));
    if (!light.directional) continue;
    bits = std::max({bits, mpz_sizeinbase(all.back()[0].get_mpz_t(), 2),
                     mpz_sizeinbase(all.back()[1].get_mpz_t(), 2)});
  }
  if (light.directional) mpz_mul_2exp(unit.get_mpz_t(), unit.get_mpz_t(), bits);
  of.reserve(all.size());
  for (DirectionVector& direction : all) {
    if (light.directional) direction[2] = unit;
    of.emplace_back(std::move(direction));
  }
}

DirectionVector LightDirections::exported(const DirectionVector& direction) const {
  return primitive({direction[0] * unit, direction[1] * unit, direction[2]});
}

}  // namespace gnomon
