// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/intent/near_vertices.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "scene/base/parallel.h"

namespace gnomon::scene_detail {

namespace {

struct Projected {
  double at;  // along a direction
  VertexId vertex;
};

/// Vertices in order along a direction in which no two planes of a usual scene look: who is near in
/// space is near in this order, and hardly anyone else is.
std::vector<Projected> in_order(const PreparedScene& scene, const LocalPoints& points) {
  constexpr long double kX = 0.5257311121L, kY = 0.3090169943L, kZ = 0.7926580101L;
  std::vector<Projected> order(scene.geometry.polygon_positions().size());
  for_each_piece(order.size(), kPieceOfCheapElements, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto vertex = static_cast<VertexId>(i);
      const Vector point = points[vertex];
      order[i] = {static_cast<double>(kX * point.x + kY * point.y + kZ * point.z), vertex};
    }
  });
  std::ranges::sort(order, {}, [](const Projected& p) { return std::tuple(p.at, p.vertex); });
  return order;
}

}  // namespace

std::vector<NearlySharedVertices> find_near_vertices(const PreparedScene& scene,
                                                     const LocalPoints& points, double near) {
  constexpr std::size_t kMostNeighbours = 64;  // of a vertex, in the order
  const std::vector<Projected> order = in_order(scene, points);
  std::vector<NearlySharedVertices> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    // Projected distances are no greater than true ones, but for rounding.
    const double farthest = order[i].at + near * (1 + 1e-9);
    for (std::size_t j = i + 1;
         j < order.size() && order[j].at <= farthest && j - i <= kMostNeighbours; ++j) {
      const VertexId a = std::min(order[i].vertex, order[j].vertex),
                     b = std::max(order[i].vertex, order[j].vertex);
      const long double distance = length_of(points[a] - points[b]);
      if (distance <= near) pairs.push_back({a, b, static_cast<double>(distance)});
    }
  }
  std::ranges::sort(pairs, {},
                    [](const NearlySharedVertices& pair) { return std::pair(pair.a, pair.b); });
  return pairs;
}

std::vector<NearlySharedEdges> find_near_edges(const PreparedScene& scene,
                                               const std::vector<NearlySharedVertices>& vertices) {
  if (vertices.empty()) return {};
  std::map<VertexId, VertexId> first;  // of the vertices near it
  for (const NearlySharedVertices& pair : vertices) {
    const auto known = first.find(pair.a);
    first.emplace(pair.b, known == first.end() ? pair.a : known->second);
  }
  const auto name = [&](VertexId vertex) {
    const auto known = first.find(vertex);
    return known == first.end() ? vertex : known->second;
  };
  // Only edges that end in the first vertex of a cluster, or in another of it, can be pairs.
  std::vector<std::uint8_t> matters(scene.geometry.positions.size(), 0);
  for (const NearlySharedVertices& pair : vertices) matters[pair.a] = matters[pair.b] = 1;
  std::map<std::pair<VertexId, VertexId>, EdgeId> seen;
  std::vector<NearlySharedEdges> pairs;
  for (std::size_t i = 0; i < scene.geometry.edges.size(); ++i) {
    const EdgeEnds& ends = scene.geometry.edges[i];
    if (matters[ends.a] == 0 && matters[ends.b] == 0) continue;
    const auto edge = static_cast<EdgeId>(i);
    VertexId a = name(ends.a), b = name(ends.b);
    if (a == b) continue;
    if (a > b) std::swap(a, b);
    const auto [known, is_new] = seen.emplace(std::pair(a, b), edge);
    if (!is_new) pairs.push_back({known->second, edge});
  }
  return pairs;
}

}  // namespace gnomon::scene_detail
