// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/rounding_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/geometry/region_width.h"

namespace gnomon::oracle {

const PlanarPoint& RoundingCells::at_vertex(std::uint32_t vertex) {
  if (places_.empty()) places_.resize(overlay_.vertex_count());
  std::optional<PlanarPoint>& place = places_[vertex];
  if (!place) place = at(overlay_.point(vertex));
  return *place;
}

const RoundingCells::ClaimedBorders& RoundingCells::claimed_borders() {
  if (!claimed_borders_) {
    ClaimedBorders& all = claimed_borders_.emplace();
    std::vector<PlanarBox> boxes;
    for (const auto& [a, b] : claimed_) {
      const Border& border = all.borders.emplace_back(Border{at(a), at(b)});
      boxes.push_back(box_of(border.a, border.b));
      all.area += rounding_area(border, radius_);
    }
    all.tree = BoxTree(std::move(boxes));
  }
  return *claimed_borders_;
}

/// What is larger than all that is near borders does not lie near borders.
bool RoundingCells::is_too_large(const std::vector<Border>& boundary) {
  // Coordinates are off by a thirtieth of the radius, and products by far less than the rest.
  constexpr long double kClearly = 1.1L;
  const PlanarPoint& base = boundary.front().a;
  long double area = 0, sum = 0, near = claimed_borders().area;
  for (const Border& border : boundary) {
    const PlanarPoint a{border.a.x - base.x, border.a.y - base.y};
    const PlanarPoint b{border.b.x - base.x, border.b.y - base.y};
    area += (a.x * b.y - a.y * b.x) / 2;
    sum += std::fabs(a.x * b.y) + std::fabs(a.y * b.x);
    near += rounding_area(border, radius_);
  }
  return std::fabs(area) > kClearly * near + 0x1p-40L * sum;
}

/// `borders`: of the cell. Its own edges do not tell all: those of loops that round to a line
/// cancel.
bool RoundingCells::is_near_claims(const PlanarLoop& piece, std::vector<Border> borders) {
  const ClaimedBorders& claimed = claimed_borders();
  std::vector<std::uint32_t> near;
  claimed.tree.meeting(box_of(piece, rounding_reach(radius_)),
                       [&](std::uint32_t border) { near.push_back(border); });
  std::ranges::sort(near);
  for (const std::uint32_t border : near) borders.push_back(claimed.borders[border]);
  return is_rounding(piece, borders, radius_);
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
  if (boundary.empty() || !is_finite(points)) return false;
  // Slivers along one border are most of what rounding makes.
  if (are_near_one(points, borders, radius_)) return true;
  if (is_too_large(borders)) return false;
  std::vector<PlanarLoop> pieces;
  for (const std::vector<ChartPoint>& corners : trapezoids_of(overlay_, boundary)) {
    PlanarLoop piece;
    for (const ChartPoint& corner : corners) piece.push_back(at(corner));
    if (area_of(piece) < 0) std::ranges::reverse(piece);
    if (!is_finite(piece)) return false;
    pieces.push_back(std::move(piece));
  }
  return !pieces.empty() && std::ranges::all_of(pieces, [&](const PlanarLoop& piece) {
    return is_rounding(piece, borders, radius_) || is_near_claims(piece, borders);
  });
}

}  // namespace gnomon::oracle
