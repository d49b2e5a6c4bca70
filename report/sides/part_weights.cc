// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/part_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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
    areas.push_back(part_area(scene, scene.parts[part]));
    total = total + to_enclosure(areas.back());
  }
  if (!(total.lower > 0) || !std::isfinite(total.upper)) areas = areas_in_ratio(scene, polygon);
  parts_.insert(parts_.end(), areas.begin(), areas.end());
}

Interval PartWeights::sum(std::uint32_t polygon, std::span<const Interval> shares) const {
  const Weights& own = *std::ranges::lower_bound(polygons_, polygon, {}, &Weights::polygon);
  oracle::Enclosure sum{0, 0}, total{0, 0};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const oracle::Enclosure weight = to_enclosure(parts_[own.first + i]);
    sum = sum + weight * to_enclosure(shares[i]);
    if (!own.coplanar) total = total + weight;
  }
  if (own.coplanar) return to_interval(sum);
  const Interval share = to_interval(sum / total);
  return {share.lower, std::min(share.upper, 1.0)};
}

}  // namespace gnomon::report
