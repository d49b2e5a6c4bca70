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

/// Leaves of each segment of `base` what no stretch covers. Sorts `covers`. Where a stretch begins
/// and the one before ends, and neither the numbers nor the names tell that nothing is between,
/// there is a segment that is not sure.
template <class Numbers>
void uncovered(std::span<const Segment<Numbers>> base, std::vector<Stretch<Numbers>>& covers,
               std::vector<Segment<Numbers>>& result) {
  if (covers.size() > 1) {
    std::sort(covers.begin(), covers.end(), [](const auto& a, const auto& b) {
      return a.low.t != b.low.t ? a.low.t < b.low.t : b.high.t < a.high.t;
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
    for (const Stretch<Numbers>& cover : covers) {
      if (!(cover.low.t < segment.high.t) && certainly_no_gap(cover.low, segment.high)) break;
      if (cover.high.t < at.t && certainly_before(cover.high, at)) continue;
      if (certainly_no_gap(at, cover.low)) {
        if (at.t < cover.high.t) at = cover.high;
        continue;
      }
      leave(earlier_of(cover.low, segment.high));
      at = later_of(at, cover.high);
    }
    leave(segment.high);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_STRETCHES_H
