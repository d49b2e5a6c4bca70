// SPDX-License-Identifier: LGPL-3.0-or-later
// A target cut by borders of tiles, so that volumes are subtracted from pieces that few of them
// meet. A floor meets all n volumes; cut by one after another it would fall into pieces each of
// which the later ones have to pass, n^2 in all.
//
// The tree of borders is made as a target goes down it, and pieces that the borders cut apart are
// joined again where they have the same class and caster (PlaneTreeFilter). Borders are a means
// only: no class depends on them.
#ifndef GNOMON_ALGORITHMS_TILING_TILE_CELLS_H
#define GNOMON_ALGORITHMS_TILING_TILE_CELLS_H

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/basic/volume_list.h"
#include "algorithms/partition/plane_tree_filter.h"
#include "algorithms/tiling/tile_grid.h"

namespace gnomon {

template <SectorSpaceModel Space>
class TileCells {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  TileCells(LightScene<Space>& light, TileGrid<Space>& grid, VolumeList<Space>& volumes)
      : light_(light), grid_(grid), volumes_(volumes), filter_(light.options.output.merge) {}

  /// As VolumeList::subtract().
  std::uint64_t subtract(const Loop& target, std::span<const VolumeId> volumes,
                         ClassifiedLoops<Vertex>& output) {
    nodes_.clear();
    members_.assign(volumes.begin(), volumes.end());
    useful_ = 0;
    root_ = make(grid_.borders().directional() ? Cell{0, kWhole, grid_.face(0)} : Cell{0, 0, {}}, 0,
                 static_cast<std::uint32_t>(members_.size()));
    filter_.filter(light_.space, Tree{*this, output}, target, output);
    return useful_;
  }
  std::uint64_t vanished() const { return filter_.vanished(); }

 private:
  /// Fewer volumes are subtracted without any further cut.
  static constexpr std::uint32_t kFew = 8;
  static constexpr std::uint32_t kWhole = 4;  // sides of a face's pyramid
  static constexpr std::int32_t kUnmade = std::numeric_limits<std::int32_t>::min();

  /// What is known of a place in light space: inside the first `sides` planes of a face's pyramid,
  /// and if inside all, in a block of its tiles.
  struct Cell {
    std::uint32_t face = 0, sides = 0;
    TileBlock block;
  };
  struct Node {
    Cell cell;
    PlaneRef plane;                    // not valid(): a leaf
    std::uint32_t begin = 0, end = 0;  // members_: the volumes that meet it
    std::int32_t front = kUnmade, back = kUnmade;
  };
  struct Tree;

  std::int32_t make(const Cell& cell, std::uint32_t begin, std::uint32_t end) {
    Node node{cell, {}, begin, end};
    if (end - begin > kFew && cell.face < grid_.borders().faces()) {
      if (cell.sides < kWhole) {
        node.plane = grid_.pyramid(cell.face)[cell.sides];
      } else if (!cell.block.is_tile()) {
        node.plane = grid_.middle(cell.block);
      }
    }
    nodes_.push_back(node);
    return static_cast<std::int32_t>(nodes_.size() - 1);
  }

  static Cell child(const Cell& cell, bool front, const TileGrid<Space>& grid) {
    if (cell.sides == kWhole) {
      return {cell.face, kWhole, front ? cell.block.above() : cell.block.below()};
    }
    if (!front) return {cell.face + 1, 0, {}};
    const std::uint32_t sides = cell.sides + 1;
    return {cell.face, sides, sides == kWhole ? grid.face(cell.face) : TileBlock{}};
  }

  std::int32_t child_of(std::uint32_t index, bool front) {
    std::int32_t link = front ? nodes_[index].front : nodes_[index].back;
    if (link != kUnmade) return link;
    const Node node = nodes_[index];
    const auto begin = static_cast<std::uint32_t>(members_.size());
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Placement placement =
          record_.decide(light_.space, node.plane, volumes_.loop(members_[i]));
      if (placement != (front ? Placement::kBack : Placement::kFront)) {
        members_.push_back(members_[i]);
      }
    }
    link = make(child(node.cell, front, grid_), begin, static_cast<std::uint32_t>(members_.size()));
    (front ? nodes_[index].front : nodes_[index].back) = link;
    return link;
  }

  LightScene<Space>& light_;
  TileGrid<Space>& grid_;
  VolumeList<Space>& volumes_;
  PlaneTreeFilter<Space> filter_;
  std::vector<Node> nodes_;
  std::vector<VolumeId> members_, near_;
  std::int32_t root_ = 0;
  std::uint64_t useful_ = 0;
  SplitRecord record_;
};

/// What PlaneTreeFilter asks. A leaf at a place is the node there that has no plane; it is told as
/// no node, and found again in at_cell().
template <SectorSpaceModel Space>
struct TileCells<Space>::Tree {
  TileCells& cells;
  ClassifiedLoops<Vertex>& output;

  std::int32_t any_node_at(TreePlace at) const {
    // The filter begins in front of a node that does not exist.
    if (at.node == kStart) return cells.root_;
    return cells.child_of(at.node - 1, at.front);
  }
  std::int32_t node_at(TreePlace at) const {
    const std::int32_t node = any_node_at(at);
    return cells.nodes_[static_cast<std::size_t>(node)].plane.valid() ? node + 1 : kNoNode;
  }
  PlaneRef plane(std::uint32_t node, const Loop&) const { return cells.nodes_[node - 1].plane; }
  Placement placement(SplitRecord& record, std::uint32_t node, const Loop& loop) const {
    return record.decide(cells.light_.space, cells.nodes_[node - 1].plane, loop);
  }
  bool is_kept(const Loop&) const { return true; }
  void at_cell(TreePlace at, const Loop& loop) const {
    const Node& leaf = cells.nodes_[static_cast<std::size_t>(any_node_at(at))];
    cells.near_.clear();
    for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) {
      const VolumeId id = cells.members_[i];
      if (cells.volumes_.place(id, loop) != ConePlace::kOutside) cells.near_.push_back(id);
    }
    cells.useful_ += cells.volumes_.subtract(loop, cells.near_, output);
  }

  static constexpr std::uint32_t kStart = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TILING_TILE_CELLS_H
