// SPDX-License-Identifier: LGPL-3.0-or-later
// Parts of an edge, and what is left of them when others are taken away.
#ifndef GNOMON_ALGORITHMS_CONTOUR_STRETCHES_H
#define GNOMON_ALGORITHMS_CONTOUR_STRETCHES_H

#include <algorithm>
#include <span>
#include <vector>

#include "algorithms/contour/numbers.h"

namespace gnomon {

/// A stretch that covers an edge.
template <class Numbers>
struct Stretch {
  Place<Numbers> low, high;
};

/// A part of an edge, and whether it certainly has a length.
template <class Numbers>
struct Segment {
  Place<Numbers> low, high;
  bool sure = true;
};

/// The least value that a place may have, and the greatest.
template <class Numbers>
auto least_of(const Place<Numbers>& place) {
  if constexpr (Numbers::kCertified) {
    return place.t - place.error;
  } else {
    return place.t;
  }
}
template <class Numbers>
auto greatest_of(const Place<Numbers>& place) {
  if constexpr (Numbers::kCertified) {
    return place.t + place.error;
  } else {
    return place.t;
  }
}

/// Whether one of the stretches from `first` on, which are in the order in which they may begin,
/// may begin before a place, and not in it.
template <class Numbers>
bool may_begin_before(const std::vector<Stretch<Numbers>>& covers, std::size_t first,
                      const Place<Numbers>& place) {
  if constexpr (Numbers::kCertified) {
    for (std::size_t i = first; i < covers.size(); ++i) {
      if (!(least_of(covers[i].low) < greatest_of(place))) return false;
      if (!is_same_place(covers[i].low, place)) return true;
    }
  }
  return false;
}

/// Leaves of each segment of `base` what no stretch covers. Sorts `covers`. Where a stretch begins
/// and the one before ends, and neither the numbers nor the names tell that nothing is between,
/// there is a segment that is not sure.
///
/// Stretches are taken in the order in which they may begin. So nothing is covered before the least
/// value of the end of a segment that is left, and what else is covered there is within its bound.
template <class Numbers>
void uncovered(std::span<const Segment<Numbers>> base, std::vector<Stretch<Numbers>>& covers,
               std::vector<Segment<Numbers>>& result) {
  if (covers.size() > 1) {
    std::sort(covers.begin(), covers.end(), [](const auto& a, const auto& b) {
      const auto at_a = least_of(a.low), at_b = least_of(b.low);
      return at_a != at_b ? at_a < at_b : b.high.t < a.high.t;
    });
  }
  result.clear();
  for (const Segment<Numbers>& segment : base) {
    Place<Numbers> at = segment.low;
    const auto leave = [&](const Place<Numbers>& end) {
      if (at.t < end.t) {
        result.push_back({at, end, segment.sure && certainly_before(at, end)});
      } else if (!certainly_no_gap(at, end)) {
        Place<Numbers> low = at, high = end;
        low.error = high.error = at.error + end.error;
        high.t = low.t;
        result.push_back({low, high, false});
      }
    };
    for (std::size_t i = 0; i < covers.size(); ++i) {
      const Stretch<Numbers>& cover = covers[i];
      if (greatest_of(segment.high) < least_of(cover.low)) break;
      if (!(cover.low.t < segment.high.t) && certainly_no_gap(cover.low, segment.high)) continue;
      if (cover.high.t < at.t && certainly_before(cover.high, at)) continue;
      if (!certainly_no_gap(at, cover.low)) {
        Place<Numbers> end = earlier_of(cover.low, segment.high);
        if (may_begin_before(covers, i + 1, end)) end.name = end.name.blurred();
        leave(end);
      }
      at = later_of(at, cover.high);
    }
    leave(segment.high);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_STRETCHES_H
