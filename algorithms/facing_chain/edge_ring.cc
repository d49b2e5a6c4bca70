// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/facing_chain/edge_ring.h"

#include <algorithm>
#include <numeric>

#include "scene/geometry/loop_geometry.h"

namespace gnomon {

namespace {

using scene_detail::point;
using Vector = scene_detail::Vec3<mpz_class>;

/// The angles of parts around an edge, counted from the first part.
class Angles {
 public:
  Angles(const GridPositions& grid, EdgeEnds edge, std::span<const EdgePart> around) {
    const Vector from = point<mpz_class>(grid, edge.a);
    axis_ = point<mpz_class>(grid, edge.b) - from;
    for (const EdgePart& part : around) {
      normals_.push_back(cross(axis_, point<mpz_class>(grid, part.off_edge) - from));
      inside_.push_back(point<mpz_class>(grid, part.off_edge) - from);
    }
    for (std::size_t i = 0; i < around.size(); ++i) half_.push_back(half_of(i));
  }

  /// Negative, zero, positive: part i comes before j, is at its angle, comes after it.
  int compare(std::size_t i, std::size_t j) const {
    if (half_[i] != half_[j]) return half_[i] - half_[j];
    return -turn(i, j);
  }

 private:
  /// Positive if j is less than half a circle after i, zero if it is at the same angle or opposite.
  int turn(std::size_t i, std::size_t j) const { return sgn(dot(normals_[i], inside_[j])); }
  /// 0: at the angle of the first; 1: below half a circle; 2: half a circle; 3: more.
  int half_of(std::size_t i) const {
    const int side = turn(0, i);
    if (side != 0) return side > 0 ? 1 : 3;
    return sgn(dot(normals_[0], normals_[i])) > 0 ? 0 : 2;
  }

  Vector axis_;
  std::vector<Vector> inside_, normals_;
  std::vector<int> half_;
};

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_around(
    const GridPositions& grid, EdgeEnds edge, std::span<const EdgePart> around) {
  const Angles angles(grid, edge, around);
  std::vector<std::uint32_t> order(around.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t i, std::uint32_t j) {
    if (const int sign = angles.compare(i, j); sign != 0) return sign < 0;
    if (around[i].flipped != around[j].flipped) return around[j].flipped;
    // Of several that lie on one another the last to open is the first to close.
    return around[i].flipped ? i < j : i > j;
  });
  // Twice around, since a wedge may hold the angle that is counted from.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<std::uint32_t> open;
  std::vector<bool> is_paired(around.size(), false);
  for (int turn = 0; turn < 2; ++turn) {
    for (const std::uint32_t i : order) {
      if (is_paired[i]) continue;
      if (around[i].flipped) {
        if (turn == 0) open.push_back(i);
      } else if (!open.empty()) {
        pairs.emplace_back(open.back(), i);
        is_paired[i] = is_paired[open.back()] = true;
        open.pop_back();
      }
    }
  }
  return pairs;
}

}  // namespace gnomon
