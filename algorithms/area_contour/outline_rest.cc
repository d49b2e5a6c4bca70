// SPDX-License-Identifier: LGPL-3.0-or-later
// What covers leave of a stretch: what certainly is seen, what perhaps is, and sharper bounds.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {

/// Whether there may be something between the place where a cover ends, or the stretch begins, and
/// one where the next begins, or the stretch ends (`is_end`). Where the bounds leave that open,
/// integers tell if they can: the first place is inside of a later cover, or beyond the stretch.
bool OutlineUnion::has_gap(const Carrier& carrier, const End& before, const End& after,
                           bool is_end) const {
  if (after.inner <= before.inner) return false;
  if (after.outer > before.outer || !before.is_known() || !after.is_known()) return true;
  if (before.line == after.line) return false;
  const OutlineLine ends = line_of(before.line), begins = line_of(after.line);
  if (exact_->is_known_same(ends, begins)) return false;
  const Side side = carrier.line == kNoLine
                        ? exact_->side_at_border(begins, ends, carrier.corner)
                        : exact_->side_of_meet(begins, line_of(carrier.line), ends);
  return side == (is_end ? Side::kFront : Side::kBack);
}

/// The end of a stretch as that of what is outside of it.
OutlineUnion::End OutlineUnion::outside(const End& end) {
  return {end.outer, end.inner, end.line, end.other, end.begins};
}

/// What certainly is seen: neither a cover nor one that perhaps is.
void OutlineUnion::find_certain(const Stretch& stretch, Lengths& rest) {
  certain_gaps_.clear();
  if (!stretch.certainly_is()) return;
  std::ranges::sort(covers_, {}, [](const Stretch& cover) { return cover.low.outer; });
  End at = outside(stretch.low);
  for (const Stretch& cover : covers_) {
    if (at.outer >= stretch.high.inner) return;
    if (cover.low.outer > at.outer) {
      if (cover.low.outer >= stretch.high.inner) break;
      rest.certain += cover.low.outer - at.outer;
      certain_gaps_.push_back({at, cover.low});
    }
    if (cover.high.outer > at.outer) at = cover.high;
  }
  if (at.outer >= stretch.high.inner) return;
  rest.certain += stretch.high.inner - at.outer;
  certain_gaps_.push_back({at, outside(stretch.high)});
}

/// What perhaps is seen: no cover that is certain.
void OutlineUnion::find_perhaps(const Carrier& carrier, const Stretch& stretch, Lengths& rest) {
  perhaps_gaps_.clear();
  std::ranges::sort(covers_, {}, [](const Stretch& cover) { return cover.low.inner; });
  // Up to here all is covered. The stretch begins where a cover of what is before it would end.
  End at = outside(stretch.low);
  const End end = outside(stretch.high);
  for (const Stretch& cover : covers_) {
    if (!cover.certainly_is()) continue;
    if (at.inner >= end.inner) return;
    if (cover.low.inner >= end.inner) break;
    if (has_gap(carrier, at, cover.low, false)) {
      rest.perhaps += cover.low.inner - at.inner;
      perhaps_gaps_.push_back({at, cover.low});
    }
    if (cover.high.inner > at.inner) at = cover.high;
  }
  if (!has_gap(carrier, at, end, true)) return;
  rest.perhaps += end.inner - at.inner;
  perhaps_gaps_.push_back({at, end});
}

/// Measures gaps between sharper places, where it is certain which they are between: no other cover
/// may reach in. What is outside of the stretch is among the covers here.
void OutlineUnion::sharpen(const Carrier& carrier, Lengths& rest) {
  const auto is_place = [](const End& a, const End& b) {
    return a.line == b.line && a.other == b.other && a.inner == b.inner && a.outer == b.outer;
  };
  const auto is_same = [&](const Gap& a, const Gap& b) {
    return is_place(a.before, b.before) && is_place(a.after, b.after);
  };
  if (carrier.line == kNoLine || !std::ranges::equal(certain_gaps_, perhaps_gaps_, is_same)) return;
  const auto is_alone = [&](const Gap& gap) {
    return std::ranges::none_of(covers_, [&](const Stretch& cover) {
      return cover.low.outer < gap.after.inner && cover.high.outer > gap.before.inner &&
             !is_place(cover.low, gap.after) && !is_place(cover.high, gap.before);
    });
  };
  Lengths sharp;
  // Of a place: the least and the greatest.
  using Bounds = std::array<double, 2>;
  const auto sharper = [&](std::uint32_t line) -> Bounds {
    const Ball place = exact_->place_on(line_of(carrier.line), line_of(line));
    return {place.lower(), place.upper()};
  };
  const auto bounds = [&](const End& end, bool is_sharp) -> Bounds {
    const Bounds known{std::min(end.inner, end.outer), std::max(end.inner, end.outer)};
    if (!is_sharp || end.line == kNoLine || known[0] == known[1]) return known;
    Bounds place = sharper(end.line);
    if (end.other != kNoLine) {
      const Bounds other = sharper(end.other);
      for (std::size_t i = 0; i < 2; ++i) {
        place[i] = end.begins ? std::max(place[i], other[i]) : std::min(place[i], other[i]);
      }
    }
    // Where cells meet before the place, or behind it, the stretch ends there.
    return {std::fmin(std::fmax(place[0], known[0]), known[1]),
            std::fmax(std::fmin(place[1], known[1]), known[0])};
  };
  for (const Gap& gap : perhaps_gaps_) {
    const bool is_sharp = is_alone(gap);
    const auto [first, after_first] = bounds(gap.before, is_sharp);
    const auto [before_last, last] = bounds(gap.after, is_sharp);
    sharp.certain += std::max(0.0, before_last - after_first);
    sharp.perhaps += last - first;
  }
  rest.certain = std::max(rest.certain, sharp.certain);
  rest.perhaps = std::min(rest.perhaps, sharp.perhaps);
}

/// Whether covers certainly hold all of an edge, one after another. What bounds leave open about
/// where they meet is not asked.
bool OutlineUnion::is_hidden(const Edge& edge) {
  std::ranges::sort(covers_, {}, [](const Stretch& cover) { return cover.low.inner; });
  double at = edge.from;
  for (const Stretch& cover : covers_) {
    if (!cover.certainly_is()) continue;
    if (cover.low.inner > at) return false;
    at = std::max(at, cover.high.inner);
    if (at >= edge.to) return true;
  }
  return false;
}

/// What the covers leave of a stretch.
OutlineUnion::Lengths OutlineUnion::rest_of(const Carrier& carrier, const Stretch& stretch) {
  Lengths rest;
  find_certain(stretch, rest);
  find_perhaps(carrier, stretch, rest);
  if (is_sharp_) {
    covers_.push_back({{-kInfinity, -kInfinity}, outside(stretch.low)});
    covers_.push_back({outside(stretch.high), {kInfinity, kInfinity}});
    sharpen(carrier, rest);
  }
  const double rounding = 2 * Ball::kUnit * static_cast<double>(covers_.size() + 4);
  rest.perhaps += rounding * rest.perhaps;
  rest.certain = std::max(0.0, rest.certain - rounding * rest.certain);
  return rest;
}

}  // namespace gnomon::area_contour
