// SPDX-License-Identifier: LGPL-3.0-or-later
// All that happens to the count along one edge: where it passes behind contour edges, where it goes
// through polygons, and what polygons that hold its ends add next to them.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_EDGE_SURVEY_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_EDGE_SURVEY_H

#include <cstdint>
#include <vector>

#include "algorithms/hidden_lines/both_sides.h"
#include "algorithms/hidden_lines/breakpoint.h"
#include "algorithms/hidden_lines/seen_surface.h"

namespace gnomon {

struct EdgeSurvey {
  std::vector<Breakpoint> breakpoints;  // inside of the edge, in order
  /// How many of the polygons that hold the start hide what comes next to it; the same for the end.
  BothSides at_start, at_end;
  /// No contour edge passes in front of the vertex, exactly: the polygons in front of it that do
  /// not hold it are the same whichever way one looks past it.
  bool is_start_clear = true, is_end_clear = true;
  std::uint64_t contour_tests = 0, polygon_tests = 0;
};

/// Requires: the edge's line does not hold the viewer.
EdgeSurvey survey_edge(const SeenSurface& surface, EdgeEnds edge);

/// By how many polygons the points next to the edge's start are hidden, found by looking at all
/// that the ray from the start may meet. Requires: as survey_edge().
BothSides count_at_start(const SeenSurface& surface, EdgeEnds edge);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_EDGE_SURVEY_H
