// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/table_mesh.h"

#include <algorithm>
#include <cstdlib>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

/// Of vertices outside the chart, which no loop names after it has been clipped.
bool is_ahead(const DirectionVector& direction) { return direction[2] > 0; }

}  // namespace

TableMesh::TableMesh(const PreparedScene& scene, const TableChart& chart)
    : scene_(scene),
      chart_(chart),
      vertex_of_(scene.geometry.positions.size(), kNone),
      edge_of_(scene.geometry.edges.size(), kNone) {}

std::uint32_t TableMesh::add_vertex(DirectionVector direction) {
  TableVertex vertex{std::move(direction), 0, 0};
  const DirectionVector& y = vertex.direction;
  if (is_ahead(y)) {
    vertex.s = mpq_class(y[0], y[2]).get_d();
    vertex.t = mpq_class(y[1], y[2]).get_d();
  }
  vertices_.push_back(std::move(vertex));
  return static_cast<std::uint32_t>(vertices_.size() - 1);
}

std::uint32_t TableMesh::vertex(VertexId id) {
  if (vertex_of_[id] == kNone) {
    const GridPositions& grid = scene_.geometry.grid;
    vertex_of_[id] = add_vertex(chart_.of({grid.at(id, 0), grid.at(id, 1), grid.at(id, 2)}));
  }
  return vertex_of_[id];
}

std::uint32_t TableMesh::add_cut(std::uint32_t from, std::uint32_t to, TableChart::Border border) {
  const DirectionVector &a = vertices_[from].direction, &b = vertices_[to].direction;
  // A positive combination of the two, which are on different sides.
  const mpz_class of_a = abs(TableChart::inside(border, b));
  const mpz_class of_b = abs(TableChart::inside(border, a));
  DirectionVector direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = of_a * a[k] + of_b * b[k];
  return add_vertex(primitive(std::move(direction)));
}

std::uint32_t TableMesh::cut(const Corner& corner, std::uint32_t to, TableChart::Border border) {
  // Pieces of borders are of one polygon alone; edges of the scene are cut once for all.
  if (corner.source >= TableEdge::kBorder) return add_cut(corner.vertex, to, border);
  const auto [place, is_new] = cuts_.try_emplace({corner.source, border}, 0);
  if (is_new) {
    const EdgeEnds ends = scene_.geometry.edges[corner.source];
    place->second = add_cut(vertex(ends.a), vertex(ends.b), border);
  }
  return place->second;
}

/// Sutherland & Hodgman, with corners and edges by name. What is on the border counts as inside.
void TableMesh::clip(std::vector<Corner>& loop, TableChart::Border border) {
  std::vector<int> sides;
  sides.reserve(loop.size());
  for (const Corner& corner : loop) {
    sides.push_back(sgn(TableChart::inside(border, vertices_[corner.vertex].direction)));
  }
  if (std::ranges::none_of(sides, [](int side) { return side > 0; })) {
    loop.clear();
    return;
  }
  if (std::ranges::none_of(sides, [](int side) { return side < 0; })) return;
  const std::uint32_t along = TableEdge::kBorder + border;
  std::vector<Corner> inside;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = i + 1 == loop.size() ? 0 : i + 1;
    const int side = sides[i], next = sides[j];
    const Corner& corner = loop[i];
    if (side >= 0) {
      inside.push_back(side == 0 && next < 0 ? Corner{corner.vertex, along} : corner);
      if (side > 0 && next < 0) inside.push_back({cut(corner, loop[j].vertex, border), along});
    } else if (next > 0) {
      inside.push_back({cut(corner, loop[j].vertex, border), corner.source, corner.flipped});
    }
  }
  loop = std::move(inside);
}

DirectedEdge TableMesh::edge_of(const Corner& corner, std::uint32_t to) {
  const auto added = [&] {
    edges_.push_back({corner.vertex, to, corner.source, corner.flipped});
    return static_cast<std::uint32_t>(edges_.size() - 1);
  };
  if (corner.source >= TableEdge::kBorder) return {added(), false};
  std::uint32_t& own = edge_of_[corner.source];
  if (own == kNone) own = added();
  return {own, edges_[own].from != corner.vertex};
}

EdgeLoop TableMesh::add(const Part& part, Side seen) {
  const auto vertices = scene_.loop(part);
  const auto edges = scene_.edges(part);
  const std::size_t count = vertices.size();
  std::vector<Corner> loop;
  for (std::size_t i = 0; i < count; ++i) {
    if (seen == Side::kFront) {
      loop.push_back({vertex(vertices[i]), edges[i].index(), edges[i].flipped()});
    } else {
      // Backwards: behind the corner k comes the edge from k - 1 to k.
      const std::size_t k = count - 1 - i;
      const PlaneRef edge = edges[(k + count - 1) % count];
      loop.push_back({vertex(vertices[k]), edge.index(), !edge.flipped()});
    }
  }
  if (chart_.is_pyramid) {
    for (std::size_t b = 0; b < TableChart::kBorders && !loop.empty(); ++b) {
      clip(loop, static_cast<TableChart::Border>(b));
    }
  }
  EdgeLoop result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    result.push_back(edge_of(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1].vertex));
  }
  return result;
}

std::vector<EdgeLoop> TableMesh::ridge_loops(std::span<const EdgeLoop> facing) const {
  std::map<std::uint32_t, int> sums;  // by edges: along them, less against them
  for (const EdgeLoop& loop : facing) {
    for (const DirectedEdge edge : loop) sums[edge.edge] += edge.reversed ? -1 : 1;
  }
  std::map<std::uint32_t, EdgeLoop> leaving;  // by vertices
  for (const auto& [edge, sum] : sums) {
    const DirectedEdge ridge{edge, sum < 0};
    for (int i = 0; i < std::abs(sum); ++i) leaving[from(ridge)].push_back(ridge);
  }
  // As many end in a vertex as start there, so that a walk ends where it began.
  std::vector<EdgeLoop> loops;
  for (auto& [start, edges] : leaving) {
    while (!edges.empty()) {
      EdgeLoop& loop = loops.emplace_back();
      std::uint32_t at = start;
      do {
        EdgeLoop& next = leaving.find(at)->second;
        loop.push_back(next.back());
        next.pop_back();
        at = to(loop.back());
      } while (at != start);
    }
  }
  return loops;
}

std::uint64_t TableMesh::bytes() const {
  return vertices_.size() * sizeof(TableVertex) + edges_.size() * sizeof(TableEdge) +
         (vertex_of_.size() + edge_of_.size()) * sizeof(std::uint32_t);
}

}  // namespace gnomon
