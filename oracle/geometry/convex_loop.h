// SPDX-License-Identifier: GPL-3.0-or-later
// Convex polygons of a chart, cut down by half-planes: what an intersection of half-spaces leaves
// of a receiver.
//
// Exactness: exact; a vertex is the meet of two lines of input planes, never of a loop's history.
#ifndef GNOMON_ORACLE_GEOMETRY_CONVEX_LOOP_H
#define GNOMON_ORACLE_GEOMETRY_CONVEX_LOOP_H

#include <span>
#include <vector>

#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

/// A convex polygon, counter-clockwise: edge i lies on line i and starts in vertex i.
struct ConvexLoop {
  std::vector<ChartPoint> vertices;
  std::vector<ChartLine> lines;
};

/// Requires: strictly convex and planar in the chart's plane.
ConvexLoop loop_in_chart(const Chart& chart, std::span<const Integers3> points);

/// Cuts away what is not strictly inside `line`; false if no area is left.
bool clip(ConvexLoop& loop, const ChartLine& line, ConvexLoop& workspace);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_CONVEX_LOOP_H
