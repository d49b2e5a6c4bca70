// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges whose line holds the viewer. No polygon that faces an eye has one; a light may lie
// anywhere.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_EDGE_TO_VIEWER_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_EDGE_TO_VIEWER_H

#include <vector>

#include "algorithms/hidden_lines/seen_surface.h"
#include "gnomon/algorithms/hidden_lines.h"

namespace gnomon {

/// The parts of such an edge. All its points have one ray, or two if the viewer is on the edge:
/// nothing is on the left or right of it, and closed polygons count.
/// Cost: all polygons that face, for each part.
std::vector<LinePart> parts_to_viewer(const SeenSurface& surface, EdgeEnds edge,
                                      const PreparedLight& light);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_EDGE_TO_VIEWER_H
