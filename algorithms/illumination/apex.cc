// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/apex.h"

#include <algorithm>
#include <utility>

namespace gnomon {

DoubleDouble pair_of(const mpz_class& numerator, const mpz_class& denominator, unsigned bits) {
  if (sgn(numerator) == 0) return {};
  // The quotient as an integer of some 115 bits and a power of two.
  const long have = static_cast<long>(mpz_sizeinbase(numerator.get_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(denominator.get_mpz_t(), 2));
  const long shift = 115 - have;
  mpz_class scaled;
  if (shift >= 0) {
    mpz_mul_2exp(scaled.get_mpz_t(), numerator.get_mpz_t(), static_cast<mp_bitcnt_t>(shift));
    mpz_tdiv_q(scaled.get_mpz_t(), scaled.get_mpz_t(), denominator.get_mpz_t());
  } else {
    mpz_tdiv_q(scaled.get_mpz_t(), numerator.get_mpz_t(), denominator.get_mpz_t());
    mpz_tdiv_q_2exp(scaled.get_mpz_t(), scaled.get_mpz_t(), static_cast<mp_bitcnt_t>(-shift));
  }
  const DoubleDouble pair = double_double(scaled);
  const long power = std::clamp(-shift - static_cast<long>(bits), -5000L, 5000L);
  return {std::ldexp(pair.high, static_cast<int>(power)),
          std::ldexp(pair.low, static_cast<int>(power))};
}

Apex Apex::from(const Geometry& geometry, ExactVector point, mpz_class weight) {
  Apex apex;
  for (std::size_t k = 0; k < 3; ++k) {
    apex.near[k] = pair_of(point[k], weight, geometry.grid.bits());
    apex.reach = std::max(apex.reach, std::fabs(apex.near[k].high) * (1 + 4 * Ball::kUnit));
  }
  apex.point = std::move(point);
  apex.weight = std::move(weight);
  return apex;
}

Apex Apex::from(const Geometry& geometry, const std::array<mpq_class, 3>& scene_units) {
  std::array<mpq_class, 3> on_grid;
  mpz_class weight = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    on_grid[k] = (scene_units[k] - geometry.origin[k]) / geometry.step;
    mpz_lcm(weight.get_mpz_t(), weight.get_mpz_t(), on_grid[k].get_den_mpz_t());
  }
  ExactVector point;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = weight / on_grid[k].get_den() * on_grid[k].get_num();
  }
  return from(geometry, std::move(point), std::move(weight));
}

VertexPairs::VertexPairs(const Geometry& geometry) {
  const GridPositions& grid = geometry.grid;
  const mpz_class one = 1;
  points_.resize(grid.size());
  for (VertexId v = 0; v < grid.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      PairPoint& point = points_[v];
      if (grid.is_narrow()) {
        const DoubleDouble pair = double_double(grid.narrow(v, k));
        const int power = -static_cast<int>(grid.bits());
        point[k] = {std::ldexp(pair.high, power), std::ldexp(pair.low, power)};
      } else {
        point[k] = pair_of(grid.wide(v, k), one, grid.bits());
      }
    }
  }
}

}  // namespace gnomon
