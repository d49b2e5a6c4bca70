// SPDX-License-Identifier: LGPL-3.0-or-later
// What an angular table is made of: the polygons of objects as a chart sees them, clipped by its
// borders, with shared edges once; and the loops of the ridge edges of each object, which are what
// is left of all edges of its facing polygons when those that run both ways cancel.
//
// Where a chart is a pyramid, polygons are clipped and the pieces of its borders close the loops.
// Exact: directions are integers.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_MESH_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_MESH_H

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/angular_table/table_chart.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct TableVertex {
  DirectionVector direction;  // alpha, beta, gamma > 0
  double s = 0, t = 0;        // each within 2u of itself
};

struct TableEdge {
  /// Of `source`: borders of the chart are from here on.
  static constexpr std::uint32_t kBorder = 0xfffffff0u;

  std::uint32_t from = 0, to = 0;  // vertices of the table
  std::uint32_t source = 0;        // an edge of the scene, or kBorder + a border
  bool flipped = false;            // it runs from the scene's edge.b to edge.a
  bool is_border() const { return source >= kBorder; }
};

/// An edge of the table in one of its directions.
struct DirectedEdge {
  std::uint32_t edge = 0;
  bool reversed = false;
  friend bool operator==(DirectedEdge, DirectedEdge) = default;
};
using EdgeLoop = std::vector<DirectedEdge>;

class TableMesh {
 public:
  TableMesh(const PreparedScene& scene, const TableChart& chart);

  /// The part's loop, counter-clockwise as seen from its side `seen`, as the chart sees it; empty
  /// if nothing of it is inside the chart. Requires, unless the chart is a pyramid: all of the part
  /// is ahead of the light.
  EdgeLoop add(const Part& part, Side seen);
  /// The ridge loops of facing polygons, as add() gave them: edges that run both ways cancel, and
  /// the rest is strung together, each as often as it is there.
  std::vector<EdgeLoop> ridge_loops(std::span<const EdgeLoop> facing) const;

  const TableChart& chart() const { return chart_; }
  const std::vector<TableVertex>& vertices() const { return vertices_; }
  const TableEdge& edge(std::uint32_t index) const { return edges_[index]; }
  std::size_t edge_count() const { return edges_.size(); }
  std::uint32_t from(DirectedEdge e) const {
    return e.reversed ? edges_[e.edge].to : edges_[e.edge].from;
  }
  std::uint32_t to(DirectedEdge e) const {
    return e.reversed ? edges_[e.edge].from : edges_[e.edge].to;
  }
  std::uint64_t bytes() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// A corner of a loop, and where the edge behind it comes from.
  struct Corner {
    std::uint32_t vertex = 0, source = 0;
    bool flipped = false;
  };

  std::uint32_t vertex(VertexId id);
  std::uint32_t add_vertex(DirectionVector direction);
  /// Where the edge behind a corner, up to `to`, meets a border. Requires: it does.
  std::uint32_t cut(const Corner& corner, std::uint32_t to, TableChart::Border border);
  std::uint32_t add_cut(std::uint32_t from, std::uint32_t to, TableChart::Border border);
  void clip(std::vector<Corner>& loop, TableChart::Border border);
  DirectedEdge edge_of(const Corner& corner, std::uint32_t to);

  const PreparedScene& scene_;
  TableChart chart_;
  std::vector<TableVertex> vertices_;
  std::vector<TableEdge> edges_;
  std::vector<std::uint32_t> vertex_of_, edge_of_;  // by vertices and edges of the scene
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cuts_;  // by source and border
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_MESH_H
