// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/claimed_shape.h"

#include <utility>

#include "oracle/geometry/group_overlay.h"
#include "oracle/geometry/overlay.h"
#include "oracle/geometry/region_width.h"

namespace gnomon::oracle {

std::vector<std::vector<HomogeneousPoint>> convex_pieces(const PreparedScene& scene,
                                                         std::uint32_t part,
                                                         const ClaimedShape& shape) {
  const Chart chart(support_of(scene, part));
  const auto projected = [&](const RationalLoop& loop) {
    std::vector<ChartPoint> points;
    for (const RationalPoint& point : loop) {
      points.push_back(chart.project(to_grid(scene.geometry, point)));
    }
    return points;
  };
  std::vector<std::vector<ChartPoint>> holes;
  for (const RationalLoop& hole : shape.holes) holes.push_back(projected(hole));
  const NormalisedLoop region = normalise(projected(shape.loop), holes);
  Overlay overlay;
  if (region.convex) overlay.add_loop(region.loop, kReceiver);
  for (const auto& [a, b] : region.edges) overlay.add_edge(a, b, kReceiver);
  overlay.build();
  std::vector<std::vector<HomogeneousPoint>> pieces;
  for (std::uint32_t face = 1; face < overlay.faces().size(); ++face) {
    if (overlay.faces()[face].winding[kReceiver] == 0) continue;
    std::vector<std::uint32_t> boundary;
    overlay.for_each_halfedge(face, [&](std::uint32_t h) {
      if (overlay.halfedges()[Overlay::twin(h)].face != face) boundary.push_back(h);
    });
    for (const std::vector<ChartPoint>& corners : trapezoids_of(overlay, boundary)) {
      std::vector<HomogeneousPoint> piece;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] == corners[(i + 1) % corners.size()]) continue;
        piece.push_back(chart.lift(corners[i]));
      }
      if (piece.size() >= 3) pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

}  // namespace gnomon::oracle
