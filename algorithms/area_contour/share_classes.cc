// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/share_classes.h"

#include <algorithm>

#include "kernel/signs/ball.h"

namespace gnomon::area_contour {
namespace {

/// A choice, not a bound: with larger errors a receiver is cut exactly.
constexpr double kWidest = 0x1p-24;

/// The share that a union covers: exactly 0 or 1, or certainly between them. None: open.
std::optional<Interval> covered(const std::optional<UnionShare>& share) {
  if (!share) return Interval{0, 0};
  if (share->hidden) return Interval{1, 1};
  Interval bounds{share->covered - share->error, share->covered + share->error};
  if (share->some) bounds.lower = std::max(bounds.lower, 0.0);
  if (!(share->error < kWidest) || !(bounds.lower > 0 || share->some) || !(bounds.upper < 1)) {
    return std::nullopt;
  }
  return bounds;
}

/// 1 - a - b, rounded outwards: each operation rounds by at most half a unit of a number below 2.
Interval rest_of(const Interval& a, const Interval& b) {
  constexpr double kOutwards = 4 * Ball::kUnit;
  return {1 - a.upper - b.upper - kOutwards, std::min(1.0, 1 - a.lower - b.lower + kOutwards)};
}

}  // namespace

bool may_be_nothing(const UnionShare& share) {
  return !share.hidden && share.error < kWidest && !(share.covered - share.error > 0);
}

std::optional<Shares> shares_of(const std::optional<UnionShare>& penumbra, bool all_penumbra,
                                const std::optional<UnionShare>& umbra) {
  const std::optional<Interval> dimmed = all_penumbra ? Interval{1, 1} : covered(penumbra);
  const std::optional<Interval> dark = covered(umbra);
  if (!dimmed || !dark) return std::nullopt;
  Shares shares;
  shares.umbra = *dark;
  const bool all_lit = dimmed->upper == 0, none_lit = dimmed->lower == 1;
  const bool all_umbra = dark->lower == 1, no_umbra = dark->upper == 0;
  shares.lit = all_lit ? Interval{1, 1} : none_lit ? Interval{0, 0} : rest_of(*dimmed, {0, 0});
  if (!none_lit && !(shares.lit.lower > 0)) return std::nullopt;
  if ((all_lit && !no_umbra) || (all_umbra && !none_lit)) return std::nullopt;  // it cannot be
  if (all_lit || all_umbra) return shares;
  if (none_lit && no_umbra) {
    shares.penumbra = {1, 1};
    return shares;
  }
  if (no_umbra) {
    shares.penumbra = *dimmed;
    return shares;
  }
  shares.penumbra = rest_of(shares.lit, shares.umbra);
  if (!(shares.penumbra.lower > 0)) return std::nullopt;
  return shares;
}

std::optional<Shares> shares_of(const UnionShare& behind_light) {
  const std::optional<Interval> dark = covered(behind_light);
  if (!dark) return std::nullopt;
  Shares shares;
  shares.umbra = *dark;
  if (dark->lower == 1) return shares;
  shares.lit = rest_of(*dark, {0, 0});
  if (!(shares.lit.lower > 0)) return std::nullopt;
  return shares;
}

}  // namespace gnomon::area_contour
