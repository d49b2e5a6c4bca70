// SPDX-License-Identifier: GPL-3.0-or-later
// A claimed fragment of one plane as a convex loop in the plane's frame, with how far the claimed
// loop is from it.
//
// Exactness: coordinates are off by kPlanarError of the greatest one; the rest is measured.
#ifndef GNOMON_ORACLE_JUDGE_BORDER_FRAGMENTS_H
#define GNOMON_ORACLE_JUDGE_BORDER_FRAGMENTS_H

#include <vector>

#include "gnomon/result/claims.h"
#include "oracle/geometry/planar_loop.h"

namespace gnomon::oracle {

struct BorderFragment {
  const ClaimedFragment* claimed = nullptr;
  PlanarLoop loop;                // its hull, counter-clockwise
  std::vector<PlanarLine> lines;  // of the hull
  long double slack = 0;          // the claimed loop leaves the hull's border by at most this
  long double thickness = 0;      // of the narrowest strip along an edge that holds it
  long double length = 0;         // greatest extent
  /// The claimed loop winds around the hull once, and otherwise only within the slack of its
  /// border. False: nothing is known but that it winds around nothing outside of the hull.
  bool regular = false;
};

/// `loop`: the claimed loop in the frame; of any orientation, at least one point.
BorderFragment border_fragment(const ClaimedFragment& claimed, PlanarLoop loop);

/// The least and the greatest value of a line on a loop that is not empty.
struct Extent {
  long double low = 0, high = 0;
  long double size() const { return high - low; }
};
Extent extent_of(const PlanarLoop& loop, const PlanarLine& line);
/// Extent along a line.
long double length_along(const PlanarLoop& loop, const PlanarLine& line);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_BORDER_FRAGMENTS_H
