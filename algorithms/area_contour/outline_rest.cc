// SPDX-License-Identifier: LGPL-3.0-or-later
// What covers leave of a stretch: what certainly is seen, what perhaps is, and sharper bounds.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {
namespace {

/// Mostly there are few, and in another order already.
template <class T, class Key>
void sort_by(std::vector<T>& values, const Key& key) {
  constexpr std::size_t kFew = 16;
  if (values.size() > kFew) {
    std::ranges::sort(values, {}, key);
    return;
  }
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(key(values[i]) < key(values[i - 1]))) continue;
    const T value = values[i];
    std::size_t k = i;
    do {
      values[k] = values[k - 1];
      --k;
    } while (k > 0 && key(value) < key(values[k - 1]));
    values[k] = value;
  }
}

}  // namespace

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
  return {end.outer, end.inner, end.line, end.other};
}

/// What certainly is seen: neither a cover nor one that perhaps is.
void OutlineUnion::find_certain(const Carrier& carrier, const Stretch& stretch, Lengths& rest) {
  const auto add = [&](const End& before, const End& after) {
    rest.certain += after.outer - before.outer;
    rest.certain_integral += carrier.integral(before.outer, after.outer);
  };
  if (!stretch.certainly_is()) return;
  sort_by(covers_, [](const Stretch& cover) { return cover.low.outer; });
  End at = outside(stretch.low);
  for (const Stretch& cover : covers_) {
    if (at.outer >= stretch.high.inner) return;
    if (cover.low.outer > at.outer) {
      if (cover.low.outer >= stretch.high.inner) break;
      add(at, cover.low);
    }
    if (cover.high.outer > at.outer) at = cover.high;
  }
  if (at.outer >= stretch.high.inner) return;
  add(at, outside(stretch.high));
}

/// What perhaps is seen: no cover that is certain.
void OutlineUnion::find_perhaps(const Carrier& carrier, const Stretch& stretch, Lengths& rest) {
  const auto add = [&](const End& before, const End& after) {
    rest.perhaps += after.inner - before.inner;
    rest.perhaps_integral += carrier.integral(before.inner, after.inner);
    perhaps_gaps_.push_back({before.inner, after.inner});
  };
  perhaps_gaps_.clear();
  sort_by(covers_, [](const Stretch& cover) { return cover.low.inner; });
  // Up to here all is covered. The stretch begins where a cover of what is before it would end.
  End at = outside(stretch.low);
  const End end = outside(stretch.high);
  for (const Stretch& cover : covers_) {
    if (!cover.certainly_is()) continue;
    if (at.inner >= end.inner) return;
    if (cover.low.inner >= end.inner) break;
    if (has_gap(carrier, at, cover.low, false)) add(at, cover.low);
    if (cover.high.inner > at.inner) at = cover.high;
  }
  if (has_gap(carrier, at, end, true)) add(at, end);
}

/// Finds an end again from integers; of the two places of one that begins a stretch the greater
/// one is meant. Where the carrier was cut before the place, or behind it, the
/// end is there: so a sharper place outside of what was known counts as that.
void OutlineUnion::sharpen(const Carrier& carrier, End& end, bool begins) const {
  if (end.line == kNoLine || end.inner == end.outer) return;
  // The least and the greatest place.
  const auto place_of = [&](std::uint32_t line) -> std::array<double, 2> {
    const Ball place = exact_->place_on(line_of(carrier.line), line_of(line));
    return {place.lower(), place.upper()};
  };
  std::array<double, 2> place = place_of(end.line);
  if (end.other != kNoLine) {
    const std::array<double, 2> other = place_of(end.other);
    for (std::size_t i = 0; i < 2; ++i) {
      place[i] = begins ? std::max(place[i], other[i]) : std::min(place[i], other[i]);
    }
  }
  const double least = std::min(end.inner, end.outer), most = std::max(end.inner, end.outer);
  if (!(place[0] <= place[1])) return;
  const double low = std::clamp(place[0], least, most), high = std::clamp(place[1], least, most);
  end.inner = end.inner == least ? low : high;
  end.outer = end.outer == least ? low : high;
}

/// Whether covers certainly hold all of an edge, one after another. What bounds leave open about
/// where they meet is not asked.
bool OutlineUnion::is_hidden(const Edge& edge) {
  if (covers_.size() < 2) return false;  // hides() has asked
  sort_by(covers_, [](const Stretch& cover) { return cover.low.inner; });
  double at = edge.from;
  for (const Stretch& cover : covers_) {
    if (!cover.certainly_is()) continue;
    if (cover.low.inner > at) return false;
    at = std::max(at, cover.high.inner);
    if (at >= edge.to) return true;
  }
  return false;
}

/// Finds those ends again that have a part in what perhaps is seen; others change nothing of it.
void OutlineUnion::sharpen(const Carrier& carrier, Stretch& stretch) {
  const auto sharpen_if_it_matters = [&](End& end, bool begins) {
    const bool matters = std::ranges::any_of(perhaps_gaps_, [&](const Gap& gap) {
      return std::max(end.inner, end.outer) >= gap.before &&
             std::min(end.inner, end.outer) <= gap.after;
    });
    if (matters) sharpen(carrier, end, begins);
  };
  sharpen_if_it_matters(stretch.low, true);
  sharpen_if_it_matters(stretch.high, false);
  for (Stretch& cover : covers_) {
    sharpen_if_it_matters(cover.low, true);
    sharpen_if_it_matters(cover.high, false);
  }
}

/// What the covers leave of a stretch. Where that leaves much open, which is so of a few edges that
/// are long, across the receiver, or end where lines are nearly parallel, ends are found sharply.
OutlineUnion::Lengths OutlineUnion::rest_of(const Carrier& carrier, Stretch stretch) {
  const auto find = [&] {
    Lengths rest;
    find_certain(carrier, stretch, rest);
    find_perhaps(carrier, stretch, rest);
    return rest;
  };
  Lengths rest = find();
  if (carrier.line != kNoLine && (rest.perhaps - rest.certain) * frame_.most > sharpen_above_) {
    sharpen(carrier, stretch);
    rest = find();
  }
  const double rounding = 2 * Ball::kUnit * static_cast<double>(covers_.size() + 4);
  rest.perhaps += rounding * rest.perhaps;
  rest.certain = std::max(0.0, rest.certain - rounding * rest.certain);
  return rest;
}

}  // namespace gnomon::area_contour
