// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/ridge_edges/loop_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

using scene_detail::Box;

/// An integer direction that has all of the loop's less than a quarter turn away, if one is found:
/// every direction that has not is added to it, which ends where there is one and some room.
std::optional<DirectionVector> pole_of(std::span<const DirectionVector* const> loop) {
  // Of a sun this one always is: its directions are points of a chart.
  const DirectionVector across{0, 0, 1};
  if (std::ranges::all_of(loop, [](const DirectionVector* one) { return (*one)[2] > 0; })) {
    return across;
  }
  constexpr int kRounds = 200;
  std::vector<FilteredVector> directions;
  for (const DirectionVector* one : loop) directions.emplace_back(*one);
  // Sums of vectors of length 2^20, so that long directions do not outweigh short ones.
  constexpr double kLength = 1 << 20;
  DirectionVector pole{0, 0, 0};
  const auto add = [&](const FilteredVector& direction) {
    for (std::size_t k = 0; k < 3; ++k) pole[k] += mpz_class(kLength * direction.nearest[k]);
  };
  for (const FilteredVector& direction : directions) add(direction);
  for (int round = 0; round < kRounds; ++round) {
    bool holds = true;
    for (const FilteredVector& direction : directions) {
      if (sgn(dot(pole, direction.exact)) > 0) continue;
      holds = false;
      add(direction);
    }
    if (holds) return pole;
  }
  return std::nullopt;
}

/// Twice the signed area of the loop where its rays meet the plane across the pole.
mpq_class chart_area(std::span<const DirectionVector* const> loop, const DirectionVector& pole) {
  mpq_class sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const DirectionVector &a = *loop[i], &b = *loop[i + 1 == loop.size() ? 0 : i + 1];
    mpq_class term(dot(pole, cross(a, b)), dot(pole, a) * dot(pole, b));
    term.canonicalize();
    sum += term;
  }
  return sum;
}

/// The solid angle on the left of the loop, in doubles, for loops that go round the light so that
/// no chart holds them: by triangles from its first ray.
double solid_angle(std::span<const DirectionVector* const> loop) {
  std::vector<std::array<double, 3>> unit;
  for (const DirectionVector* one : loop) unit.push_back(FilteredVector(*one).nearest);
  double sum = 0;
  for (std::size_t i = 1; i + 1 < unit.size(); ++i) {
    const auto &a = unit[0], &b = unit[i], &c = unit[i + 1];
    sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  constexpr double kAll = 4 * std::numbers::pi;
  sum = std::fmod(sum, kAll);
  return sum < 0 ? sum + kAll : sum;
}

/// The box of a cone on the unit sphere: of its rays, and as much more as the sphere bulges out of
/// their hull, 1 - cos of the angle from the middle to the farthest.
Box box_of(std::span<const VertexId> loop, std::span<const FilteredVector> directions) {
  constexpr double kRounding = 1e-12;
  std::array<double, 3> middle{};
  Box box = Box::empty();
  for (const VertexId vertex : loop) {
    for (std::size_t k = 0; k < 3; ++k) middle[k] += directions[vertex].nearest[k];
  }
  const double length = std::hypot(middle[0], middle[1], middle[2]);
  double farthest = 4;  // no middle: all directions
  if (length > 0) {
    farthest = 0;
    for (double& c : middle) c /= length;
    for (const VertexId vertex : loop) {
      const std::array<double, 3> apart = minus(directions[vertex].nearest, middle);
      farthest = std::max(farthest, dot(apart, apart));
    }
  }
  const double bulge = (farthest < 1 ? farthest / 2 : 4) + kRounding;
  for (const VertexId vertex : loop) {
    for (int k = 0; k < 3; ++k) {
      const double c = directions[vertex].nearest[static_cast<std::size_t>(k)];
      box.add(k, c - bulge, c + bulge);
    }
  }
  return box;
}

Box box_of(const FilteredVector& ray) {
  constexpr double kRounding = 1e-12;
  Box box = Box::empty();
  for (int k = 0; k < 3; ++k) {
    const double c = ray.nearest[static_cast<std::size_t>(k)];
    box.add(k, c - kRounding, c + kRounding);
  }
  return box;
}

}  // namespace

FacingCones::FacingCones(const PreparedScene& scene, std::span<const std::uint32_t> parts,
                         std::span<const Side> facing, std::span<const FilteredVector> directions) {
  std::vector<Box> boxes;
  for (const std::uint32_t index : parts) {
    const Part& part = scene.parts[index];
    if (facing[index] == Side::kOn || !part.casts) continue;
    const auto loop = scene.loop(part);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const VertexId a = loop[i], b = loop[i + 1 == loop.size() ? 0 : i + 1];
      const bool turned = facing[index] == Side::kBack;
      normals_.emplace_back(
          cross(directions[turned ? b : a].exact, directions[turned ? a : b].exact));
    }
    starts_.push_back(static_cast<std::uint32_t>(normals_.size()));
    boxes.push_back(box_of(loop, directions));
  }
  tree_.emplace(boxes);
}

bool FacingCones::holds(std::uint32_t cone, const FilteredVector& middle,
                        const FilteredVector& left, const FilteredVector& ahead) const {
  for (std::uint32_t k = starts_[cone]; k < starts_[cone + 1]; ++k) {
    Sign sign = side(normals_[k], middle);
    if (sign == Sign::kZero) sign = side(normals_[k], left);
    if (sign == Sign::kZero) sign = side(normals_[k], ahead);
    if (sign != Sign::kPositive) return false;
  }
  return true;
}

std::uint32_t FacingCones::depth_left_of(const DirectionVector& from,
                                         const DirectionVector& to) const {
  // A positive sum of the ends is between them. Where it is on an edge of a cone, the direction a
  // little to the left tells, and where the edge runs straight to the left, one a little ahead.
  DirectionVector sum;
  for (std::size_t k = 0; k < 3; ++k) sum[k] = from[k] + to[k];
  const FilteredVector middle(sum), left(cross(from, to)), ahead(cross(left.exact, sum));
  std::uint32_t depth = 0;
  tree_->for_each_that_meets(box_of(middle), [&](std::uint32_t cone) {
    if (holds(cone, middle, left, ahead)) ++depth;
  });
  return depth;
}

bool is_counter_clockwise(std::span<const DirectionVector* const> loop) {
  if (const auto pole = pole_of(loop)) return chart_area(loop, *pole) > 0;
  return solid_angle(loop) < 2 * std::numbers::pi;
}

}  // namespace gnomon
