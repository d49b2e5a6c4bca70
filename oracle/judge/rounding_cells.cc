// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/rounding_cells.h"

#include <algorithm>

#include "oracle/geometry/region_width.h"

namespace gnomon::oracle {

const PlanarPoint& RoundingCells::at_vertex(std::uint32_t vertex) {
  if (places_.empty()) places_.resize(overlay_.vertex_count());
  std::optional<PlanarPoint>& place = places_[vertex];
  if (!place) place = at(overlay_.point(vertex));
  return *place;
}

const std::vector<Border>& RoundingCells::claimed_borders() {
  if (claimed_borders_.empty()) {
    for (const auto& [a, b] : claimed_) claimed_borders_.push_back({at(a), at(b)});
  }
  return claimed_borders_;
}

bool RoundingCells::contains(std::uint32_t face) {
  if (!(radius_ > 0)) return false;
  std::vector<std::uint32_t> boundary;
  std::vector<Border> borders;
  PlanarLoop points;
  overlay_.for_each_halfedge(face, [&](std::uint32_t h) {
    borders.push_back({at_vertex(overlay_.halfedges()[h].origin), at_vertex(overlay_.target(h))});
    points.push_back(borders.back().a);
    if (overlay_.halfedges()[Overlay::twin(h)].face != face) boundary.push_back(h);
  });
  if (boundary.empty()) return false;
  // Slivers along one border are most of what rounding makes.
  if (are_near_one(points, borders, radius_)) return true;
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
    if (!all_claimed) {
      const std::vector<Border>& claimed = claimed_borders();
      borders.insert(borders.end(), claimed.begin(), claimed.end());
    }
    all_claimed = true;
    if (!is_rounding(piece, borders, radius_)) return false;
  }
  return true;
}

}  // namespace gnomon::oracle
