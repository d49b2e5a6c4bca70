// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/grid_lines.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "algorithms/partition/fractions.h"
#include "kernel/implicit/implicit_scene_space.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {

GridLines::GridLines(mpq_class step, bool rounded)
    : step_(std::move(step)), nearest_step_(step_.get_d()), rounded_(rounded) {
  constexpr std::size_t kShort = 53;
  is_short_ = mpz_sizeinbase(step_.get_num_mpz_t(), 2) <= kShort &&
              mpz_sizeinbase(step_.get_den_mpz_t(), 2) <= kShort;
}

double GridLines::rounded_at(std::int64_t line) const {
  if (is_short_) {
    const double numerator = static_cast<double>(line) * step_.get_num().get_d();
    // Below 2^53 the product is exact.
    if (std::fabs(numerator) < 0x1p53) return numerator / step_.get_den().get_d();
  }
  return nearest_double(step_ * mpq_class(static_cast<long>(line)));
}

mpq_class GridLines::at(std::int64_t line) const {
  return rounded_ ? mpq_class(rounded_at(line)) : step_ * mpq_class(static_cast<long>(line));
}

std::int64_t GridLines::place(const PointTable& points, std::uint32_t point, int axis) const {
  const auto k = static_cast<std::size_t>(axis);
  const ExactPoint& exact = points.exact(point);
  if (!rounded_) {
    mpz_class quotient, rest;
    const mpz_class dividend = exact.numerator[k] * step_.get_den();
    const mpz_class divisor = exact.denominator * step_.get_num();
    mpz_fdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), dividend.get_mpz_t(), divisor.get_mpz_t());
    return 2 * std::int64_t{quotient.get_si()} + (sgn(rest) != 0 ? 1 : 0);
  }
  // Rounding to the nearest double keeps the order, and lines are doubles: only a coordinate whose
  // nearest double is a line may be on either side of it.
  const double nearest = points.nearest(point)[k];
  auto line = static_cast<std::int64_t>(std::floor(nearest / nearest_step_));
  while (rounded_at(line) > nearest) --line;
  while (rounded_at(line + 1) <= nearest) ++line;
  if (rounded_at(line) != nearest) return 2 * line + 1;
  const mpq_class at(nearest);
  const int order = cmp(exact.numerator[k] * at.get_den(), at.get_num() * exact.denominator);
  return 2 * line + (order > 0 ? 1 : order < 0 ? -1 : 0);
}

MeshPlane mesh_plane(const PreparedScene& scene, PlaneId plane) {
  const Geometry& geometry = scene.geometry;
  const ExactGeometry<mpz_class> exact(geometry);
  const auto [n, d] = exact.plane(plane);
  const Chart chart = chart_of(geometry, plane);
  MeshPlane result;
  // Position = origin + step * grid, so that n . position = n . origin + step * d.
  result.d = geometry.step * d;
  for (std::size_t k = 0; k < 3; ++k) {
    result.n[k] = n[k];
    result.d += geometry.origin[k] * n[k];
  }
  result.axes = {chart.u, chart.v};
  return result;
}

}  // namespace gnomon
