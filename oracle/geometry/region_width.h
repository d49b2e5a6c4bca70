// SPDX-License-Identifier: GPL-3.0-or-later
// The diameter of the largest disc inside a region of the overlay, enclosed by bounds, and a point
// inside the region.
//
// Method: the region is cut exactly into trapezoids between its boundary edges. For a convex piece
// T and a boundary edge e no disc centred in T has a radius above max dist(corner of T, e), since
// the distance to a convex set is convex; nor above half of max (dist(corner, e) + dist(corner, f))
// for two edges e and f, which is right for long T between them. The least of these bounds T from
// above, a disc around a point of T from below. Pieces are halved, worst first, until both bounds
// are close. Guarantee: the bounds hold up to the rounding of the coordinates, which is added to
// them.
#ifndef GNOMON_ORACLE_GEOMETRY_REGION_WIDTH_H
#define GNOMON_ORACLE_GEOMETRY_REGION_WIDTH_H

#include <limits>

#include "gnomon/oracle/enclosure.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/overlay.h"

namespace gnomon::oracle {

/// Lengths in a chart: |(dx, dy)| in space is |(a dx + b dy, c dy)|, grid units.
struct ChartMetric {
  double a = 1, b = 0, c = 1;
  explicit ChartMetric(const Chart& chart);
};

struct RegionShape {
  Enclosure width;      // scene units; from above at most `most`
  ChartPoint interior;  // strictly inside the region
};

/// What is asked of a region's width, scene units.
struct WidthQuestion {
  long double step = 1;   // of the grid
  double resolution = 0;  // bounds that are closer are not made closer
  /// A bound that the caller knows, of a strip that holds the region, say; infinity: none. It is
  /// what is told from above of a region of so many trapezoids that they are not all looked at.
  double most = std::numeric_limits<double>::infinity();
};

/// `boundary`: the halfedges that have the region on their left and something else on their right.
RegionShape measure_region(const Overlay& overlay, const ChartMetric& metric,
                           const std::vector<std::uint32_t>& boundary,
                           const WidthQuestion& question);

/// No disc in a region of this area is wider: 2 sqrt(area / pi), rounded up. The area is that share
/// of `whole`.
double width_of_area(double share, double whole);

/// The region between such halfedges as convex pieces: trapezoids with two sides along y.
std::vector<std::vector<ChartPoint>> trapezoids_of(const Overlay& overlay,
                                                   const std::vector<std::uint32_t>& boundary);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_REGION_WIDTH_H
