// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/shares/gross_shares.h"

#include <algorithm>
#include <map>
#include <optional>

#include "report/sides/part_area.h"

namespace gnomon::report {

namespace {

/// The positions of a loop, whatever it begins with and whichever way it goes round.
using LoopKey = std::vector<VertexId>;
LoopKey key_of(const PreparedScene& prepared, std::span<const VertexId> loop) {
  LoopKey key;
  for (const VertexId vertex : loop) key.push_back(prepared.vertex_of_input[vertex]);
  std::ranges::sort(key);
  return key;
}

/// Whether two polygons of parallel planes look the same way.
bool look_alike(const PreparedScene& prepared, std::uint32_t a, std::uint32_t b) {
  const auto of_a = doubled_area_vector(prepared, prepared.parts[prepared.first_part[a]]);
  const auto of_b = doubled_area_vector(prepared, prepared.parts[prepared.first_part[b]]);
  return of_a[0] * of_b[0] + of_a[1] * of_b[1] + of_a[2] * of_b[2] > 0;
}

}  // namespace

GrossShares::GrossShares(const Scene& scene, const PreparedScene& prepared,
                         const ShareColumns& columns) {
  std::map<LoopKey, std::uint32_t> polygons;  // without holes
  std::map<std::pair<std::uint32_t, Side>, std::size_t> column_of;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const std::uint32_t polygon = columns.polygon(column);
    column_of.emplace(std::pair(polygon, columns.side(column)), column);
    if (scene.polygons[polygon].holes.empty()) {
      polygons.emplace(key_of(prepared, scene.polygons[polygon].loop), polygon);
    }
  }
  const PolygonAreas areas(prepared);
  const auto area_of = [&](std::uint32_t polygon) {
    if (areas_fit_doubles(prepared)) return areas.nearest(polygon);
    double sum = 0;
    for (std::uint32_t part = prepared.first_part[polygon]; part < prepared.first_part[polygon + 1];
         ++part) {
      sum += comparable_area(prepared, prepared.parts[part]).middle();
    }
    return sum;
  };
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const std::uint32_t polygon = columns.polygon(column);
    if (columns.side(column) != Side::kFront) continue;
    Wall wall{scene.polygons[polygon].id + "#gross", {{column, area_of(polygon)}}};
    for (const auto& hole : scene.polygons[polygon].holes) {
      const auto opening = polygons.find(key_of(prepared, hole));
      if (opening == polygons.end()) continue;
      const Side side = look_alike(prepared, polygon, opening->second) ? Side::kFront : Side::kBack;
      const auto its = column_of.find({opening->second, side});
      if (its != column_of.end()) wall.columns.push_back({its->second, area_of(opening->second)});
    }
    if (wall.columns.size() == 1) continue;
    double whole = 0;
    for (const Weighted& part : wall.columns) whole += part.weight;
    for (Weighted& part : wall.columns) part.weight /= whole;
    walls_.push_back(std::move(wall));
  }
}

std::vector<std::string> GrossShares::names() const {
  std::vector<std::string> names;
  for (const Wall& wall : walls_) names.push_back(wall.name);
  return names;
}

void GrossShares::read(std::span<const double> lit, std::span<double> gross) const {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const std::vector<Weighted>& parts = walls_[i].columns;
    const auto all = [&](double share) {
      return std::ranges::all_of(parts,
                                 [&](const Weighted& part) { return lit[part.column] == share; });
    };
    gross[i] = all(1) ? 1 : 0;
    if (all(1) || all(0)) continue;
    for (const Weighted& part : parts) gross[i] += part.weight * lit[part.column];
  }
}

}  // namespace gnomon::report
