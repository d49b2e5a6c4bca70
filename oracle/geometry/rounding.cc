// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace gnomon::oracle {

namespace {

/// Coordinates of error and borders are off by 2^-58 of the greatest coordinate, and the radius is
/// at least 0.8 * 2^-53 of it: 4 in 100 for each of the two.
constexpr long double kReach = 1.08L;
constexpr int kSides = 16;                // of the polygon around what is near a border: 2 in 100
constexpr std::size_t kMostPieces = 500;  // what needs more is not near borders alone

struct Turn {
  long double sine = 0, cosine = 1;
};

/// From the normal of a border to those of the sides around it: the two along it first, which cut
/// most.
const std::array<Turn, kSides>& turns_to_sides() {
  static const std::array<Turn, kSides> turns = [] {
    std::array<Turn, kSides> all;
    for (int i = 0; i < kSides; ++i) {
      const int k = i < 2 ? i * kSides / 2 : (i - 1) + (i - 1) / (kSides / 2);
      const long double angle = 2 * std::acos(-1.0L) * k / kSides;
      all[i] = {std::sin(angle), std::cos(angle)};
    }
    return all;
  }();
  return turns;
}

/// All that is within a distance of a border, and a little more at its ends.
std::vector<PlanarLine> surroundings(const Border& border, long double distance) {
  PlanarLine line = line_through(border.a, border.b);
  if (line.a == 0 && line.b == 0) line.a = 1;
  std::vector<PlanarLine> bounds;
  bounds.reserve(kSides);
  for (const auto& [sine, cosine] : turns_to_sides()) {
    const PlanarLine outward{cosine * line.a - sine * line.b, sine * line.a + cosine * line.b, 0};
    const long double farthest = std::max(outward.at(border.a), outward.at(border.b));
    bounds.push_back({-outward.a, -outward.b, farthest + distance});
  }
  return bounds;
}

long double distance_to(const Border& border, const PlanarPoint& point) {
  const long double dx = border.b.x - border.a.x, dy = border.b.y - border.a.y;
  const long double px = point.x - border.a.x, py = point.y - border.a.y;
  const long double squared = dx * dx + dy * dy;
  if (!(squared > 0)) return std::hypot(px, py);
  const long double t = std::clamp((px * dx + py * dy) / squared, 0.0L, 1.0L);
  return std::hypot(px - t * dx, py - t * dy);
}

PlanarPoint middle_of(const PlanarLoop& loop) {
  PlanarPoint sum;
  for (const PlanarPoint& point : loop) {
    sum.x += point.x / static_cast<long double>(loop.size());
    sum.y += point.y / static_cast<long double>(loop.size());
  }
  return sum;
}

}  // namespace

long double rounding_radius(const Scene& scene, const PreparedScene& prepared,
                            std::uint32_t polygon) {
  double greatest = 0;
  for (std::uint32_t part = prepared.first_part[polygon]; part < prepared.first_part[polygon + 1];
       ++part) {
    for (const VertexId vertex : prepared.loop(prepared.parts[part])) {
      for (const double coordinate : prepared.geometry.positions[vertex]) {
        greatest = std::max(greatest, std::fabs(coordinate));
      }
    }
  }
  const double next = std::nextafter(greatest, std::numeric_limits<double>::infinity());
  const long double unit = static_cast<long double>(next) - greatest;
  const long double half_diagonal = std::sqrt(3.0L) / 2 * unit;
  return scene.numbers == NumberMeaning::kDecimal ? 2 * half_diagonal : half_diagonal;
}

long double rounding_reach(long double radius) { return kReach * radius; }

bool are_near_one(const PlanarLoop& points, std::span<const Border> borders, long double radius) {
  if (!(radius > 0) || points.empty() || !is_finite(points)) return false;
  const long double reach = rounding_reach(radius);
  return std::ranges::any_of(borders, [&](const Border& border) {
    return std::ranges::all_of(
        points, [&](const PlanarPoint& point) { return distance_to(border, point) <= reach; });
  });
}

long double rounding_area(const Border& border, long double radius) {
  // The sides of a polygon around a disc are off by 2 in 100.
  const long double reach = 1.03L * rounding_reach(radius);
  return reach * (2 * std::hypot(border.b.x - border.a.x, border.b.y - border.a.y) + 3.2L * reach);
}

bool is_rounding(long double distance, long double radius) {
  return radius > 0 && distance <= rounding_reach(radius);
}

bool is_rounding(const PlanarLoop& error, std::span<const Border> borders, long double radius) {
  if (!(radius > 0) || error.empty() || !is_finite(error)) return false;
  const long double reach = rounding_reach(radius);
  const PlanarBox box = box_of(error, reach);
  std::vector<Border> near;
  for (const Border& border : borders) {
    if (box.meets(box_of(border.a, border.b))) near.push_back(border);
  }
  if (are_near_one(error, near, radius)) return true;
  const PlanarPoint middle = middle_of(error);
  const auto holds_middle = [&](const Border& border) {
    return distance_to(border, middle) <= reach;
  };
  if (std::ranges::none_of(near, holds_middle)) return false;
  std::vector<PlanarLoop> left{error};
  for (const Border& border : near) {
    left = without(std::move(left), surroundings(border, reach));
    if (left.empty()) return true;
    if (left.size() > kMostPieces) return false;
  }
  return false;
}

}  // namespace gnomon::oracle
