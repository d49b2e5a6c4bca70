// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/form_factors/target_pieces.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace gnomon {

TargetPiece front_of(const TargetPiece& piece, const HalfSpace& half_space, double shift) {
  const auto value = [&](const TargetPoint& point) { return half_space.at(point) - shift; };
  TargetPiece front;
  bool inside = false;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const TargetPoint &a = piece[i], &b = piece[i + 1 == piece.size() ? 0 : i + 1];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) front.push_back(a);
    inside |= at_a > 0;
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
      const double s = at_a / (at_a - at_b);
      TargetPoint cut{(1 - s) * a.x + s * b.x, (1 - s) * a.w + s * b.w};
      if (cut.w == 0) cut.x = unit(cut.x);
      front.push_back(cut);
    }
  }
  if (!inside || front.size() < 3) front.clear();
  return front;
}

namespace {

/// Whether all of the piece is outside of one of the half-spaces, moved by what `shift` says.
template <class Shift>
bool misses(const TargetPiece& piece, std::span<const HalfSpace> cone, const Shift& shift) {
  return std::ranges::any_of(cone, [&](const HalfSpace& half_space) {
    const double least = shift(half_space);
    return std::ranges::all_of(
        piece, [&](const TargetPoint& point) { return half_space.at(point) <= least; });
  });
}

}  // namespace

void take_away(std::vector<TargetPiece>& pieces, std::span<const HalfSpace> cone, Leaves leaves) {
  const auto shift = [&](const HalfSpace& half_space) {
    return leaves == Leaves::kNearest ? 0
           : leaves == Leaves::kMore  ? half_space.margin
                                      : -half_space.margin;
  };
  std::vector<TargetPiece> left;
  for (TargetPiece& piece : pieces) {
    if (misses(piece, cone, shift)) {
      left.push_back(std::move(piece));
      continue;
    }
    TargetPiece rest = std::move(piece);
    for (const HalfSpace& half_space : cone) {
      const double least = shift(half_space);
      const HalfSpace opposite{-1 * half_space.normal, -half_space.offset};
      TargetPiece outside = front_of(rest, opposite, -least);
      if (!outside.empty()) left.push_back(std::move(outside));
      rest = front_of(rest, half_space, least);
      if (rest.empty()) break;
    }
  }
  pieces.swap(left);
}

bool may_reach(std::span<const TargetPiece> pieces, std::span<const HalfSpace> cone) {
  const auto shift = [](const HalfSpace& half_space) { return -half_space.margin; };
  for (const TargetPiece& piece : pieces) {
    if (misses(piece, cone, shift)) continue;
    TargetPiece rest = piece;
    for (const HalfSpace& half_space : cone) {
      rest = front_of(rest, half_space, -half_space.margin);
      if (rest.empty()) break;
    }
    if (!rest.empty()) return true;
  }
  return false;
}

double point_factor(const TargetPiece& piece, const Vector& point, const Vector& normal) {
  double sum = 0;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const TargetPoint &p = piece[i], &q = piece[i + 1 == piece.size() ? 0 : i + 1];
    const Vector a = p.x - p.w * point, b = q.x - q.w * point;
    const Vector across = cross(a, b);
    const double sine = length(across);
    if (sine > 0) sum += std::atan2(sine, dot(a, b)) / sine * dot(across, normal);
  }
  return std::fabs(sum) / (2 * std::numbers::pi);
}

}  // namespace gnomon
