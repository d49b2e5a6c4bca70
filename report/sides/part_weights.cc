// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/part_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "kernel/numbers/double_double.h"
#include "report/sides/part_area.h"

namespace gnomon::report {

bool is_coplanar(const PreparedScene& scene, std::uint32_t polygon) {
  const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
  return std::all_of(scene.parts.begin() + first, scene.parts.begin() + last,
                     [&](const Part& part) { return part.plane == scene.parts[first].plane; });
}

std::vector<mpq_class> exact_weights(const PreparedScene& scene, std::uint32_t polygon) {
  const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
  const std::array<mpz_class, 3> normal = doubled_area_vector(scene, scene.parts[first]);
  std::size_t axis = 0;
  while (normal[axis] == 0) ++axis;
  std::vector<mpz_class> areas;
  mpz_class total = 0;
  for (std::uint32_t part = first; part < last; ++part) {
    areas.push_back(abs(doubled_area_vector(scene, scene.parts[part])[axis]));
    total += areas.back();
  }
  std::vector<mpq_class> weights;
  for (const mpz_class& area : areas) {
    weights.emplace_back(area, total);
    weights.back().canonicalize();
  }
  return weights;
}

namespace {

/// Areas of the polygon's parts in units of the largest, which doubles hold at every scale.
std::vector<Interval> areas_in_ratio(const PreparedScene& scene, std::uint32_t polygon) {
  std::vector<mpz_class> squares;
  for (std::uint32_t part = scene.first_part[polygon]; part < scene.first_part[polygon + 1];
       ++part) {
    const std::array<mpz_class, 3> vector = doubled_area_vector(scene, scene.parts[part]);
    squares.emplace_back(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
  }
  const mpz_class largest = *std::ranges::max_element(squares);
  std::vector<Interval> areas;
  for (const mpz_class& square : squares) {
    mpq_class ratio(square, largest);
    ratio.canonicalize();
    areas.push_back(to_interval(oracle::enclose_square_root(ratio)));
  }
  return areas;
}

/// A sum of products of doubles that are not negative, in a pair of doubles: n of them err by less
/// than 2^-102 n of the sum, and by what underflows.
class ProductSum {
 public:
  void add(double a, double b) {
    sum_ = sum_ + two_product(a, b);
    ++count_;
  }
  double rounded_down() const { return std::max(0.0, rounded(-1)); }
  double rounded_up() const { return rounded(1); }

 private:
  double rounded(int sign) const {
    const double error = count_ * (0x1p-101 * sum_.high + 0x1p-1060);
    const DoubleDouble far = two_sum(sum_.high, sum_.low + sign * error);
    // The pair's lower half is itself rounded: by far less than the error allows for.
    return sign * far.low <= 0 ? far.high : std::nextafter(far.high, sign * INFINITY);
  }

  DoubleDouble sum_;
  double count_ = 0;
};

}  // namespace

PartWeights::PartWeights(const PreparedScene& scene) {
  for (std::uint32_t polygon = 0; polygon + 1 < scene.first_part.size(); ++polygon) {
    if (scene.first_part[polygon + 1] - scene.first_part[polygon] > 1) add(scene, polygon);
  }
}

PartWeights::PartWeights(const PreparedScene& scene, std::uint32_t polygon) { add(scene, polygon); }

void PartWeights::add(const PreparedScene& scene, std::uint32_t polygon) {
  const bool coplanar = is_coplanar(scene, polygon);
  polygons_.push_back({polygon, coplanar, static_cast<std::uint32_t>(parts_.size())});
  if (coplanar) {
    for (const mpq_class& weight : exact_weights(scene, polygon)) {
      parts_.push_back(to_interval(oracle::enclose(weight)));
    }
    return;
  }
  std::vector<Interval> areas;
  oracle::Enclosure total{0, 0};
  for (std::uint32_t part = scene.first_part[polygon]; part < scene.first_part[polygon + 1];
       ++part) {
    areas.push_back(comparable_area(scene, scene.parts[part]));
    total = total + to_enclosure(areas.back());
  }
  if (!(total.lower > 0) || !std::isfinite(total.upper)) areas = areas_in_ratio(scene, polygon);
  parts_.insert(parts_.end(), areas.begin(), areas.end());
}

Interval PartWeights::sum(std::uint32_t polygon, std::span<const Interval> shares) const {
  for (const double whole : {0.0, 1.0}) {
    const auto is_whole = [&](const Interval& share) {
      return share.lower == whole && share.upper == whole;
    };
    if (std::ranges::all_of(shares, is_whole)) return {whole, whole};
  }
  const Weights& own = *std::ranges::lower_bound(polygons_, polygon, {}, &Weights::polygon);
  ProductSum lower, upper, lower_total, upper_total;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Interval& weight = parts_[own.first + i];
    lower.add(weight.lower, shares[i].lower);
    upper.add(weight.upper, shares[i].upper);
    lower_total.add(weight.lower, 1);
    upper_total.add(weight.upper, 1);
  }
  const oracle::Enclosure sum{lower.rounded_down(), upper.rounded_up()};
  if (own.coplanar) return {std::max(sum.lower, 0.0), std::min(sum.upper, 1.0)};
  const Interval share =
      to_interval(sum / oracle::Enclosure{lower_total.rounded_down(), upper_total.rounded_up()});
  return {std::max(share.lower, 0.0), std::min(share.upper, 1.0)};
}

}  // namespace gnomon::report
