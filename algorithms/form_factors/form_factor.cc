// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/form_factor.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "algorithms/form_factors/factor_cells.h"

namespace gnomon {

namespace {

/// Of casters, for the order in which they are looked at alone: those that are nearer are not told
/// apart, in a scene of extent 1.
constexpr double kNearest = 1e-9;
/// How wide the bounds of a factor may be if nothing hides anything: what roundings of thousands of
/// cells (factor_cells.cc) add to it, so that a tolerance of 0 can be met.
constexpr double kBoundsAlone = 1e-9;

/// The scene in doubles, moved and scaled into the unit cube: every coordinate is off by half a
/// unit.
class UnitScene {
 public:
  explicit UnitScene(const PreparedScene& scene) : scene_(scene) {}

  std::vector<Vector> loop(const Part& part) const {
    const auto& grid = scene_.geometry.grid;
    std::vector<Vector> loop;
    for (const VertexId vertex : scene_.loop(part)) {
      Vector& point = loop.emplace_back();
      for (int k = 0; k < 3; ++k) {
        long exponent = 0;
        const mpz_class coordinate = grid.at(vertex, k);
        const double mantissa = mpz_get_d_2exp(&exponent, coordinate.get_mpz_t());
        point[static_cast<std::size_t>(k)] =
            std::ldexp(mantissa, static_cast<int>(exponent - static_cast<long>(grid.bits())));
      }
    }
    return loop;
  }
  /// Counter-clockwise seen from the side.
  BlockingSide side(const Part& part, Side side) const {
    BlockingSide result{loop(part), {}};
    if (side == Side::kBack) std::ranges::reverse(result.loop);
    Vector sum{};
    const auto& points = result.loop;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      sum = sum + cross(points[i] - points[0], points[i + 1] - points[0]);
    }
    result.plane.normal = unit(sum);
    result.plane.offset = dot(result.plane.normal, points[0]);
    return result;
  }

 private:
  const PreparedScene& scene_;
};

std::span<const Part> parts_of(const PreparedScene& scene, std::uint32_t polygon) {
  return std::span(scene.parts)
      .subspan(scene.first_part[polygon],
               scene.first_part[polygon + 1] - scene.first_part[polygon]);
}

bool some_in_front(const std::vector<Vector>& loop, const HalfSpace& plane) {
  return std::ranges::any_of(loop, [&](const Vector& point) {
    return plane.at({point, 1}) > kMargin;
  });
}

/// The sides of all casters that may hide something of a target that lies in front of the part,
/// those that look largest from its middle first. `target`: the target's part, null for the sky.
std::vector<BlockingSide> blocking_sides(const PreparedScene& scene, const UnitScene& in_unit,
                                         const Part& from, const BlockingSide& looking,
                                         const Part* target) {
  std::vector<std::pair<double, BlockingSide>> found;
  Vector middle{};
  for (const Vector& point : looking.loop) {
    middle = middle + 1.0 / static_cast<double>(looking.loop.size()) * point;
  }
  for (const Part& part : scene.parts) {
    if (!part.casts || part.plane == from.plane) continue;
    if (target != nullptr && part.plane == target->plane) continue;
    for (const Side side : {Side::kFront, Side::kBack}) {
      if (side == Side::kBack && !part.two_sided) continue;
      BlockingSide own = in_unit.side(part, side);
      const HalfSpace behind{-1 * own.plane.normal, -own.plane.offset};
      if (!some_in_front(own.loop, looking.plane) || !some_in_front(looking.loop, behind)) continue;
      double nearest = kNearest;
      for (const Vector& point : own.loop) nearest = std::max(nearest, length(point - middle));
      found.emplace_back(-area_of(own.loop) / (nearest * nearest), std::move(own));
    }
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, BlockingSide>::first);
  std::vector<BlockingSide> sides;
  for (auto& [size, side] : found) sides.push_back(std::move(side));
  return sides;
}

/// The sky as four cones around `up`.
std::vector<TargetPiece> sky_pieces(const Vector& up) {
  const Vector axis = std::fabs(up[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  const Vector e = unit(cross(axis, up)), f = cross(up, e);
  const std::array<Vector, 4> round{e, f, -1 * e, -1 * f};
  std::vector<TargetPiece> pieces;
  for (std::size_t k = 0; k < 4; ++k) {
    pieces.push_back({{round[k], 0}, {round[(k + 1) % 4], 0}, {up, 0}});
  }
  return pieces;
}

std::vector<TargetPiece> in_front(const std::vector<TargetPiece>& pieces, const HalfSpace& plane) {
  std::vector<TargetPiece> front;
  for (const TargetPiece& piece : pieces) {
    TargetPiece own = front_of(piece, plane, 0);
    if (!own.empty()) front.push_back(std::move(own));
  }
  return front;
}

class FactorSum {
 public:
  FactorSum(const PreparedScene& scene, const FormFactorOptions& options, std::uint32_t from,
            Side side)
      : scene_(scene), options_(options), in_unit_(scene), from_(from), side_(side) {
    for (const Part& part : parts_of(scene, from)) area_ += area_of(in_unit_.loop(part));
  }

  /// What the sky is to all parts.
  void add_sky(const Vector& up) {
    for (const Part& part : parts_of(scene_, from_)) {
      const BlockingSide looking = in_unit_.side(part, side_);
      FactorTask task{looking.loop, looking.plane.normal, {}, {}};
      task.target = in_front(sky_pieces(up), {looking.plane.normal, 0});
      task.blocks = blocking_sides(scene_, in_unit_, part, looking, nullptr);
      add(task, area_of(looking.loop) / area_);
    }
  }

  void add_polygon(std::uint32_t to) {
    for (const Part& part : parts_of(scene_, from_)) {
      for (const Part& target : parts_of(scene_, to)) {
        if (part.plane == target.plane) continue;
        for (const Side side : {Side::kFront, Side::kBack}) {
          if (side == Side::kBack && !target.two_sided) continue;
          add_pair(part, target, in_unit_.side(target, side));
        }
      }
    }
  }

  Expected<FormFactor> result() const {
    if (options_.interrupted != nullptr && *options_.interrupted) {
      return fail(ErrorCode::kInterrupted, "interrupted");
    }
    FormFactor factor;
    factor.cells = sums_.cells;
    if (!(area_ > 0)) return factor;
    factor.value = sums_.value / area_;
    factor.lower = std::max(0.0, sums_.lower / area_);
    factor.upper = std::min(1.0, sums_.upper / area_);
    factor.value = std::clamp(factor.value, factor.lower, factor.upper);
    factor.unobstructed = std::clamp(sums_.unobstructed / area_, 0.0, 1.0);
    factor.within_tolerance = factor.upper - factor.lower <= options_.tolerance + kBoundsAlone;
    return factor;
  }

 private:
  void add_pair(const Part& part, const Part& target, const BlockingSide& shown) {
    BlockingSide looking = in_unit_.side(part, side_);
    // Only what is in front of the target's side is seen from it.
    TargetPiece own;
    for (const Vector& point : looking.loop) own.push_back({point, 1});
    own = front_of(own, shown.plane, 0);
    TargetPiece piece;
    for (const Vector& point : shown.loop) piece.push_back({point, 1});
    piece = front_of(piece, looking.plane, 0);
    if (own.empty() || piece.empty()) return;
    looking.loop.clear();
    for (const TargetPoint& point : own) looking.loop.push_back(point.x);
    FactorTask task{looking.loop, looking.plane.normal, {std::move(piece)}, {}};
    task.blocks = blocking_sides(scene_, in_unit_, part, looking, &target);
    const auto targets = static_cast<double>(parts_of(scene_, target.polygon).size());
    add(task, area_of(in_unit_.loop(part)) / area_ / targets);
  }

  /// `share`: of the tolerance and of the cells.
  void add(const FactorTask& task, double share) {
    const double parts = static_cast<double>(parts_of(scene_, from_).size());
    const auto cells = static_cast<std::uint64_t>(
        std::max(16.0, static_cast<double>(options_.most_cells) / std::max(1.0, parts)));
    const FactorSums own =
        factor_sums(task, options_.tolerance * area_ * share, cells, options_.interrupted);
    sums_.value += own.value;
    sums_.lower += own.lower;
    sums_.upper += own.upper;
    sums_.unobstructed += own.unobstructed;
    sums_.cells += own.cells;
  }

  const PreparedScene& scene_;
  const FormFactorOptions& options_;
  UnitScene in_unit_;
  std::uint32_t from_;
  Side side_;
  double area_ = 0;
  FactorSums sums_;
};

}  // namespace

Expected<FormFactor> sky_factor(const PreparedScene& scene, std::uint32_t polygon, Side side,
                                const FormFactorOptions& options) {
  const Vector& up = options.up;
  const double size = std::max({std::fabs(up[0]), std::fabs(up[1]), std::fabs(up[2])});
  if (!(size > 0) || !std::isfinite(size)) {
    return fail(ErrorCode::kUsage, "up is no direction", "a vector that is not 0");
  }
  FactorSum sum(scene, options, polygon, side);
  sum.add_sky(unit(1 / size * up));
  return sum.result();
}

Expected<FormFactor> view_factor(const PreparedScene& scene, std::uint32_t from, Side side,
                                 std::uint32_t to, const FormFactorOptions& options) {
  FactorSum sum(scene, options, from, side);
  sum.add_polygon(to);
  return sum.result();
}

}  // namespace gnomon
