// SPDX-License-Identifier: LGPL-3.0-or-later
// Merges triangles into convex parts across their diagonals: rule 4 of polygon_cut.h.
#ifndef GNOMON_SCENE_PREPARE_CONVEX_MERGE_H
#define GNOMON_SCENE_PREPARE_CONVEX_MERGE_H

#include <array>
#include <tuple>

#include "scene/prepare/chart.h"
#include "scene/prepare/ear_clipper.h"

namespace gnomon::scene_detail {

/// Loops of the merged parts, collinear vertices dropped. Every directed edge occurs at most once.
template <class Int>
std::vector<Ring> merge_convex(const Chart<Int>& chart, const std::vector<Triangle>& triangles) {
  struct HalfEdge {
    std::uint32_t origin, next, previous;
    bool gone;
  };
  std::vector<HalfEdge> halves;
  halves.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(halves.size());
    for (std::uint32_t k = 0; k < 3; ++k) {
      halves.push_back({triangle[k], first + (k + 1) % 3, first + (k + 2) % 3, false});
    }
  }
  const auto target = [&](std::uint32_t h) { return halves[halves[h].next].origin; };

  // Both halves of a diagonal have the same pair of ends; sorted by the pair of keys.
  using Diagonal = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // keys, half-edge
  std::vector<Diagonal> diagonals;
  diagonals.reserve(halves.size());
  for (std::uint32_t h = 0; h < halves.size(); ++h) {
    const std::uint32_t a = chart.key(halves[h].origin), b = chart.key(target(h));
    diagonals.emplace_back(std::min(a, b), std::max(a, b), h);
  }
  std::sort(diagonals.begin(), diagonals.end());
  for (std::size_t i = 0; i + 1 < diagonals.size(); ++i) {
    const auto& [low, high, h] = diagonals[i];
    const auto& [other_low, other_high, t] = diagonals[i + 1];
    if (low != other_low || high != other_high) continue;
    ++i;
    const std::uint32_t before_h = halves[h].previous, after_h = halves[h].next;
    const std::uint32_t before_t = halves[t].previous, after_t = halves[t].next;
    const bool convex =
        chart.turn(halves[before_h].origin, halves[h].origin, target(after_t)) != Sign::kNegative &&
        chart.turn(halves[before_t].origin, halves[t].origin, target(after_h)) != Sign::kNegative;
    if (!convex) continue;
    halves[before_h].next = after_t;
    halves[after_t].previous = before_h;
    halves[before_t].next = after_h;
    halves[after_h].previous = before_t;
    halves[h].gone = halves[t].gone = true;
  }

  std::vector<Ring> parts;
  for (std::uint32_t h = 0; h < halves.size(); ++h) {
    if (halves[h].gone) continue;
    Ring part;
    for (std::uint32_t k = h; !halves[k].gone; k = halves[k].next) {
      halves[k].gone = true;
      if (chart.turn(halves[halves[k].previous].origin, halves[k].origin, target(k)) !=
          Sign::kZero) {
        part.push_back(halves[k].origin);
      }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_CONVEX_MERGE_H
