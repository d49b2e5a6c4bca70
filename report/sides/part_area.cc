// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/part_area.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "gnomon/oracle/enclosure.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon::report {

namespace {

mpz_class squared_length(const std::array<mpz_class, 3>& vector) {
  return vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2];
}

/// Twice the area vector of a loop whose vertices have integer coordinates, in `Integer`.
template <class Integer, class At>
std::array<Integer, 3> doubled_loop_area(std::span<const VertexId> loop, const At& at) {
  std::array<Integer, 3> origin{}, a{}, b{}, sum{};
  for (int k = 0; k < 3; ++k) origin[k] = at(loop[0], k);
  for (int k = 0; k < 3; ++k) a[k] = at(loop[1], k) - origin[k];
  for (std::size_t i = 2; i < loop.size(); ++i) {
    for (int k = 0; k < 3; ++k) b[k] = at(loop[i], k) - origin[k];
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      sum[k] += a[u] * b[v] - a[v] * b[u];
    }
    std::swap(a, b);
  }
  return sum;
}

/// The root of a sum of squares to 160 bits beyond the integer part: the error is far below a
/// double's. Exact in a plane of constant x, y or z.
mpq_class precise_part_area(const PreparedScene& scene, const Part& part) {
  constexpr unsigned kShift = 160;
  const std::array<mpz_class, 3> doubled = doubled_area_vector(scene, part);
  mpq_class area;
  if (std::ranges::count(doubled, 0) == 2) {
    area = abs(doubled[0] + doubled[1] + doubled[2]);
    area >>= 1;
  } else {
    mpz_class root = squared_length(doubled) << (2 * kShift);
    mpz_sqrt(root.get_mpz_t(), root.get_mpz_t());
    area = root;
    area >>= kShift + 1;
  }
  if (scene.geometry.step == 1) return area;
  return area * scene.geometry.step * scene.geometry.step;
}

}  // namespace

std::array<mpz_class, 3> doubled_area_vector(const PreparedScene& scene, const Part& part) {
  const auto loop = scene.loop(part);
  const GridPositions& grid = scene.geometry.grid;
  // Each triangle of b-bit coordinates adds less than 2^(2b + 1).
  if (2 * grid.bits() + 1 + std::bit_width(loop.size()) <= 63) {
    const auto sum = doubled_loop_area<std::int64_t>(
        loop, [&](VertexId vertex, int axis) { return grid.narrow(vertex, axis); });
    return {static_cast<long>(sum[0]), static_cast<long>(sum[1]), static_cast<long>(sum[2])};
  }
  return doubled_loop_area<mpz_class>(
      loop, [&](VertexId vertex, int axis) { return grid.at(vertex, axis); });
}

Interval part_area(const PreparedScene& scene, const Part& part) {
  mpq_class squared(squared_length(doubled_area_vector(scene, part)));
  const mpq_class step_squared = scene.geometry.step * scene.geometry.step;
  squared *= step_squared * step_squared;
  squared /= 4;
  const oracle::Enclosure area = oracle::enclose_square_root(squared);
  return {area.lower, area.upper};
}

double nearest_area(const PreparedScene& scene, const Part& part) {
  return nearest_double(precise_part_area(scene, part));
}

mpq_class precise_area(const PreparedScene& scene, std::uint32_t polygon) {
  mpq_class sum = 0;
  for (std::uint32_t part = scene.first_part[polygon]; part < scene.first_part[polygon + 1];
       ++part) {
    sum += precise_part_area(scene, scene.parts[part]);
  }
  return sum;
}

}  // namespace gnomon::report
