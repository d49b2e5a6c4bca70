// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/piece_fractions.h"

namespace gnomon {

PlaneCharts::PlaneCharts(const Geometry& geometry) {
  dropped_.reserve(geometry.planes.size());
  for (PlaneId plane = 0; plane < geometry.planes.size(); ++plane) {
    const SupportTriple& triple = geometry.planes[plane];
    const auto& a = geometry.positions[triple.a];
    std::array<double, 3> s, t;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      s[k] = geometry.positions[triple.b][k] - a[k];
      t[k] = geometry.positions[triple.c][k] - a[k];
      size = std::max({size, std::fabs(a[k]), std::fabs(s[k]), std::fabs(t[k])});
    }
    const std::array<double, 3> n = {std::fabs(s[1] * t[2] - s[2] * t[1]),
                                     std::fabs(s[2] * t[0] - s[0] * t[2]),
                                     std::fabs(s[0] * t[1] - s[1] * t[0])};
    const int largest = n[2] >= n[0] && n[2] >= n[1] ? 2 : n[1] >= n[0] ? 1 : 0;
    // Positions err by u size, so components of n by less than 32u size^2: far from zero, any will
    // do. Otherwise the exact normal decides.
    if (n[static_cast<std::size_t>(largest)] > 0x1p-40 * size * size && size < 0x1p400) {
      dropped_.push_back(static_cast<std::uint8_t>(largest));
    } else {
      const Chart chart = chart_of(geometry, plane);
      dropped_.push_back(static_cast<std::uint8_t>(3 - chart.u - chart.v));
    }
  }
}

mpq_class twice_exact_area(const PreparedScene& scene, const Part& part) {
  const Geometry& geometry = scene.geometry;
  const auto [u, v] = chart_of(geometry, part.plane);
  const auto loop = scene.loop(part);
  mpz_class sum = 0;
  const auto at = [&](std::uint32_t i, int axis) {
    return mpz_class(geometry.grid.at(loop[i], axis) - geometry.grid.at(loop[0], axis));
  };
  for (std::uint32_t i = 1; i + 1 < part.count; ++i) {
    sum += at(i, u) * at(i + 1, v) - at(i, v) * at(i + 1, u);
  }
  return geometry.step * geometry.step * abs(sum);
}

}  // namespace gnomon
