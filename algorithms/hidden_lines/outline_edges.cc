// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "gnomon/algorithms/hidden_lines.h"

namespace gnomon {

namespace {

/// An edge of one of a polygon's parts that face, and which way it runs there.
struct PolygonEdge {
  EdgeId edge = 0;
  std::uint32_t polygon = 0;
  int runs = 0;
  friend bool operator<(const PolygonEdge& a, const PolygonEdge& b) {
    return std::pair(a.edge, a.polygon) < std::pair(b.edge, b.polygon);
  }
};

}  // namespace

std::vector<OutlineEdge> outline_edges(const PreparedScene& scene, std::span<const Side> facing) {
  std::vector<PolygonEdge> all;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    if (facing[i] == Side::kOn) continue;
    for (const PlaneRef edge : scene.edges(scene.parts[i])) {
      const bool forward = edge.flipped() != (facing[i] == Side::kFront);
      all.push_back({edge.index(), scene.parts[i].polygon, forward ? 1 : -1});
    }
  }
  std::ranges::sort(all, [](const PolygonEdge& a, const PolygonEdge& b) { return a < b; });
  std::vector<OutlineEdge> outline;
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    int runs = 0;
    for (end = i; end < all.size() && !(all[i] < all[end]); ++end) runs += all[end].runs;
    if (runs == 0) continue;
    if (outline.empty() || outline.back().edge != all[i].edge) {
      outline.push_back({all[i].edge, {}});
    }
    outline.back().polygons.push_back(all[i].polygon);
  }
  return outline;
}

}  // namespace gnomon
