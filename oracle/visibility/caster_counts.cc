// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/caster_counts.h"

#include <vector>

#include "oracle/geometry/overlay.h"

namespace gnomon::oracle {

namespace {

/// In the chart of its plane, which all shadows on it are in.
std::vector<ChartPoint> loop_of(const PreparedScene& scene, std::uint32_t part) {
  std::vector<Integers3> points;
  for (const VertexId vertex : scene.loop(scene.parts[part])) {
    const auto& grid = scene.geometry.grid;
    points.push_back({grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)});
  }
  const Chart chart(plane_of(points));
  std::vector<ChartPoint> loop;
  for (const Integers3& point : points) loop.push_back(chart.at(point));
  return loop;
}

/// Twice the area in the chart.
mpq_class doubled_area(const std::vector<ChartPoint>& loop) {
  mpq_class sum;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const ChartPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    mpq_class term(a.x * b.y - b.x * a.y, a.w * b.w);
    term.canonicalize();
    sum += term;
  }
  return abs(sum);
}

}  // namespace

std::map<std::uint32_t, mpq_class> caster_counts(const PreparedScene& scene,
                                                 const PointRegions& regions, std::uint32_t part) {
  if (regions.lit_side(part) == Side::kOn) return {};
  const std::vector<ChartPoint> receiver = loop_of(scene, part);
  Overlay overlay;
  const auto add = [&](const std::vector<ChartPoint>& points, Layer layer) {
    const int turn = orientation(points[0], points[1], points[2]);
    overlay.add_loop(points, layer, turn < 0 ? -1 : 1);
  };
  add(receiver, kReceiver);
  for (const ShadowPiece& shadow : regions.shadows_on(part)) {
    if (shadow.caster != ShadowPiece::kOutsideRegion) add(shadow.loop, kTruth);
  }
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

std::map<std::uint32_t, mpq_class> caster_shares(const PreparedScene& scene,
                                                 const PointRegions& regions, std::uint32_t part) {
  if (regions.lit_side(part) == Side::kOn) return {};
  const mpq_class whole = doubled_area(loop_of(scene, part));
  std::map<std::uint32_t, mpq_class> shares;
  for (const ShadowPiece& shadow : regions.shadows_on(part)) {
    if (shadow.caster == ShadowPiece::kOutsideRegion) continue;
    shares[shadow.caster] += doubled_area(shadow.loop) / whole;
  }
  return shares;
}

}  // namespace gnomon::oracle
