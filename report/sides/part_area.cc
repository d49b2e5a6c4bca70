// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/part_area.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

#include "gnomon/oracle/enclosure.h"
#include "kernel/numbers/double_double.h"
#include "kernel/numbers/exact_integer.h"
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

/// As long as 128 bits hold it; each triangle of b-bit coordinates adds less than 2^(2b + 1).
bool fits(const PreparedScene& scene, const Part& part, unsigned bits) {
  const GridPositions& grid = scene.geometry.grid;
  return grid.is_narrow() && 2 * grid.bits() + 1 + std::bit_width(part.count) <= bits;
}
template <class Integer>
std::array<Integer, 3> narrow_area_vector(const PreparedScene& scene, const Part& part) {
  return doubled_loop_area<Integer>(scene.loop(part), [&](VertexId vertex, int axis) {
    return Integer{scene.geometry.grid.narrow(vertex, axis)};
  });
}

// Of a polygon's area, as a pair of doubles: a component of an area vector is off by 2^-104 of
// itself, its square and the sum of three by less than 2^-100, the root of that by half of it and
// 2^-102. Adding kMostParts parts adds less than 2^-99, the square of the step 2^-100, and each of
// two products 2^-102. precise_area() leaves out less than 2^-159. All this is below 2^-97.
constexpr double kError = 0x1p-96;
constexpr std::uint32_t kMostParts = 16;
/// Never 0: a pair that has underflowed decides nothing.
std::optional<double> nearest_of(const DoubleDouble& area) {
  return nearest_double(area, kError * std::fabs(area.high) + 0x1p-1000);
}
/// A product of two doubles is rounded once, unless it is very small or large.
bool is_moderate(double value) { return std::fabs(value) > 0x1p-800 && std::fabs(value) < 0x1p800; }

template <class Integer>
DoubleDouble length(const std::array<Integer, 3>& vector) {
  DoubleDouble squared;
  for (const Integer& component : vector) {
    const DoubleDouble pair = double_double(component);
    squared = squared + pair * pair;
  }
  return square_root(squared);
}

/// Twice the area on the grid; not a number where 128 bits are too few. `exact`: becomes false
/// unless the pair is exact and one double: in a plane of constant x, y or z.
DoubleDouble doubled_pair_area(const PreparedScene& scene, const Part& part, bool& exact) {
  if (fits(scene, part, 63)) {
    const auto vector = narrow_area_vector<std::int64_t>(scene, part);
    if (std::ranges::count(vector, 0) == 2) {
      const DoubleDouble area = double_double(std::abs(vector[0] + vector[1] + vector[2]));
      exact = exact && area.low == 0;
      return area;
    }
    exact = false;
    return length(vector);
  }
  exact = false;
  if (fits(scene, part, 125)) return length(narrow_area_vector<Int128>(scene, part));
  return {NAN, 0};
}

}  // namespace

std::array<mpz_class, 3> doubled_area_vector(const PreparedScene& scene, const Part& part) {
  if (fits(scene, part, 63)) {
    const auto sum = narrow_area_vector<std::int64_t>(scene, part);
    return {static_cast<long>(sum[0]), static_cast<long>(sum[1]), static_cast<long>(sum[2])};
  }
  return doubled_loop_area<mpz_class>(scene.loop(part), [&](VertexId vertex, int axis) {
    return scene.geometry.grid.at(vertex, axis);
  });
}

Interval part_area(const PreparedScene& scene, const Part& part) {
  mpq_class squared(squared_length(doubled_area_vector(scene, part)));
  const mpq_class step_squared = scene.geometry.step * scene.geometry.step;
  squared *= step_squared * step_squared;
  squared /= 4;
  const oracle::Enclosure area = oracle::enclose_square_root(squared);
  return {area.lower, area.upper};
}

bool areas_fit_doubles(const PreparedScene& scene) {
  constexpr long kFar = 450;  // a box of 2^900 or 2^-900 leaves room for what is smaller or larger
  const mpq_class& step = scene.geometry.step;
  const auto width = static_cast<long>(scene.position_bits) +
                     static_cast<long>(mpz_sizeinbase(step.get_num_mpz_t(), 2)) -
                     static_cast<long>(mpz_sizeinbase(step.get_den_mpz_t(), 2));
  return std::labs(width) < kFar;
}

Interval comparable_area(const PreparedScene& scene, const Part& part) {
  if (areas_fit_doubles(scene)) return part_area(scene, part);
  // The grid's box is 2^b wide; squares of twice the areas.
  mpq_class squared(squared_length(doubled_area_vector(scene, part)));
  squared >>= 4 * static_cast<mp_bitcnt_t>(scene.position_bits) + 2;
  const oracle::Enclosure area = oracle::enclose_square_root(squared);
  return {area.lower, area.upper};
}

double nearest_area(const PreparedScene& scene, const Part& part) {
  return nearest_double(precise_area(scene, part));
}

// The root of a sum of squares to 160 bits beyond the integer part: the error is far below a
// double's. Exact in a plane of constant x, y or z.
mpq_class precise_area(const PreparedScene& scene, const Part& part) {
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

mpq_class precise_area(const PreparedScene& scene, std::uint32_t polygon) {
  mpq_class sum = 0;
  for (std::uint32_t part = scene.first_part[polygon]; part < scene.first_part[polygon + 1];
       ++part) {
    sum += precise_area(scene, scene.parts[part]);
  }
  return sum;
}

PolygonAreas::PolygonAreas(const PreparedScene& scene) : scene_(scene) {
  const DoubleDouble step = double_double(scene.geometry.step);
  DoubleDouble half_square = step * step * DoubleDouble{0.5, 0};
  const bool exact_step =
      std::isfinite(half_square.high) &&
      2 * mpq_class(half_square.high) == scene.geometry.step * scene.geometry.step;
  if (exact_step) half_square.low = 0;
  const std::size_t polygons = scene.first_part.empty() ? 0 : scene.first_part.size() - 1;
  areas_.reserve(polygons);
  for (std::size_t polygon = 0; polygon < polygons; ++polygon) {
    const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
    DoubleDouble doubled;
    bool exact = exact_step;
    if (last - first > kMostParts) doubled = {NAN, 0};
    for (std::uint32_t part = first; part < last && !std::isnan(doubled.high); ++part) {
      doubled = doubled + doubled_pair_area(scene, scene.parts[part], exact);
      exact = exact && doubled.low == 0;
    }
    const DoubleDouble area = doubled * half_square;
    exact = exact && area.low == 0 && is_moderate(area.high);
    areas_.push_back({area.high, area.low, exact});
  }
}

double PolygonAreas::nearest(std::uint32_t polygon) const {
  const Area& area = areas_[polygon];
  if (area.exact) return area.high;
  const auto nearest = nearest_of({area.high, area.low});
  return nearest ? *nearest : nearest_double(precise_area(scene_, polygon));
}

double PolygonAreas::nearest(std::uint32_t polygon, double fraction) const {
  const Area& area = areas_[polygon];
  const double product = area.high * fraction;
  if (area.exact && is_moderate(product)) return product;
  const auto nearest = nearest_of(DoubleDouble{area.high, area.low} * DoubleDouble{fraction, 0});
  return nearest ? *nearest : this->nearest(polygon, mpq_class(fraction));
}

double PolygonAreas::nearest(std::uint32_t polygon, const mpq_class& fraction) const {
  return nearest_double(fraction * precise_area(scene_, polygon));
}

}  // namespace gnomon::report
