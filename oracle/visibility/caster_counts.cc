// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/caster_counts.h"

#include <vector>

#include "oracle/geometry/overlay.h"

namespace gnomon::oracle {

std::map<std::uint32_t, mpq_class> caster_counts(const PreparedScene& scene,
                                                 const PointRegions& regions, std::uint32_t part) {
  if (regions.lit_side(part) == Side::kOn) return {};
  std::vector<Integers3> loop;
  for (const VertexId vertex : scene.loop(scene.parts[part])) {
    const auto& grid = scene.geometry.grid;
    loop.push_back({grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)});
  }
  const Chart chart(plane_of(loop));
  std::vector<ChartPoint> receiver;
  for (const Integers3& point : loop) receiver.push_back(chart.at(point));
  Overlay overlay;
  const auto add = [&](const std::vector<ChartPoint>& points, Layer layer) {
    const int turn = orientation(points[0], points[1], points[2]);
    overlay.add_loop(points, layer, turn < 0 ? -1 : 1);
  };
  add(receiver, kReceiver);
  for (const ShadowPiece& shadow : regions.shadows_on(part)) add(shadow.loop, kTruth);
  overlay.build();
  if (!overlay.consistent()) return {};
  std::map<std::uint32_t, std::vector<bool>> faces;  // by count
  std::vector<bool> all(overlay.faces().size(), false);
  for (std::size_t face = 1; face < overlay.faces().size(); ++face) {
    const Winding& winding = overlay.faces()[face].winding;
    if (winding[kReceiver] == 0) continue;
    auto& own = faces[static_cast<std::uint32_t>(winding[kTruth])];
    own.resize(overlay.faces().size(), false);
    own[face] = all[face] = true;
  }
  const mpq_class whole = overlay.exact_area(all);
  std::map<std::uint32_t, mpq_class> shares;
  for (const auto& [count, own] : faces) shares[count] = overlay.exact_area(own) / whole;
  return shares;
}

}  // namespace gnomon::oracle
