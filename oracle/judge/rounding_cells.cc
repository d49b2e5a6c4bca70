// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/rounding_cells.h"

#include <algorithm>

#include "oracle/geometry/region_width.h"

namespace gnomon::oracle {

bool RoundingCells::contains(std::uint32_t face) {
  if (!(radius_ > 0)) return false;
  std::vector<std::uint32_t> boundary;
  std::vector<Border> borders;
  overlay_.for_each_halfedge(face, [&](std::uint32_t h) {
    borders.push_back({at(overlay_.point(overlay_.halfedges()[h].origin)),
                       at(overlay_.point(overlay_.target(h)))});
    if (overlay_.halfedges()[Overlay::twin(h)].face != face) boundary.push_back(h);
  });
  std::vector<PlanarLoop> pieces;
  for (const std::vector<ChartPoint>& corners : trapezoids_of(overlay_, boundary)) {
    PlanarLoop piece;
    for (const ChartPoint& corner : corners) piece.push_back(at(corner));
    if (area_of(piece) < 0) std::ranges::reverse(piece);
    pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) return false;
  bool all_claimed = false;
  for (const PlanarLoop& piece : pieces) {
    if (is_rounding(piece, borders, radius_)) continue;
    // Its own edges do not tell all: those of loops that round to a line cancel.
    if (!all_claimed)
      borders.insert(borders.end(), claimed_borders_.begin(), claimed_borders_.end());
    all_claimed = true;
    if (!is_rounding(piece, borders, radius_)) return false;
  }
  return true;
}

}  // namespace gnomon::oracle
