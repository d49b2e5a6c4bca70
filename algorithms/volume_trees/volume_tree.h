// SPDX-License-Identifier: LGPL-3.0-or-later
// A tree of shadow volumes: the penumbra tree or the umbra tree of one area light (Chin & Feiner
// 1992), as a BSP tree whose cells are OUT, or IN with the caster whose volume covers them.
//
// Its planes are those of the volumes, inside in front, below a balanced prefix of axis planes. It
// grows by a true set union (Thibault & Naylor 1987): a volume goes down the tree as a convex
// polyhedron that the nodes split; what reaches an OUT cell extends the tree there by those planes
// that bound the piece *and* are the volume's own, for the planes that cut it stand above the cell
// already. A caster's whole volume goes in, once. (1992, fig. 6, shows what happens otherwise.)
//
// Guarantee on exact kernels: an interior point of the box that the volumes were cut out of is in
// an IN cell if and only if it is in one of them, up to the planes of nodes, whatever the order
// of insertion and the prefix. Explicit stacks.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_VOLUME_TREE_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_VOLUME_TREE_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/plane_tree_filter.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "algorithms/volume_trees/balanced_prefix.h"
#include "algorithms/volume_trees/polyhedron.h"
#include "gnomon/algorithms/shadow_result.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// CellLoop is a convex loop that one cell holds.
struct CellLoop {
  LoopRange loop;                              // in CellOutput::loops
  std::uint32_t caster = Fragment::kNoCaster;  // kNoCaster: OUT

  bool is_like(const CellLoop& other) const { return caster == other.caster; }
};

template <class Vertex>
using CellOutput = FilteredLoops<Vertex, CellLoop>;

/// ReceivingSide says on which side of a loop light arrives: a loop that lies *in* a node's plane
/// belongs to the cell just in front of it (docs: semantics, the class is that limit).
template <class Vertex>
struct ReceivingSide {
  PlaneRef plane;                // of the loop, receiving side in front
  const Corner<Vertex>* before;  // some point strictly in front of it: a vertex of the light
};

/// What one thread needs to put volumes into trees whose planes are those of a space.
template <VolumeSpaceModel Space>
struct TreeGrower {
  using Vertex = typename Space::Vertex;

  explicit TreeGrower(Space& planes) : space(&planes) {}
  /// A piece that is on its way down; pieces[i] goes to places[i], i < places.size().
  Polyhedron<Vertex>& piece(std::size_t i) {
    if (pieces.size() <= i) pieces.resize(i + 1);
    return pieces[i];
  }

  Space* space;
  PolyhedronSplitter<Space> splitter;
  std::vector<TreePlace> places;
  std::vector<Polyhedron<Vertex>> pieces;
  Polyhedron<Vertex> whole;  // that is being split
};

template <VolumeSpaceModel Space>
class VolumeTree {
 public:
  using Vertex = typename Space::Vertex;
  using Grower = TreeGrower<Space>;

  explicit VolumeTree(const Rules& rules = {}) : rules_(rules), nodes_(1) {}

  /// Puts a balanced prefix at the top, whose planes it adds to `space`. Requires: nothing inserted
  /// yet.
  void plant(Space& space, const SpacePrefix& prefix);

  /// Adds a volume to the union, and takes the volume: what is left of it is of no use. `base`: the
  /// caster's plane. Returns false, and leaves the tree in an undefined state, if it would have
  /// more than `most_nodes`.
  bool insert(Grower& grower, Polyhedron<Vertex>& volume, PlaneId base, std::uint32_t caster,
              std::uint64_t most_nodes);
  /// Calls at_out(place, piece) for each piece of a volume that reaches an OUT cell, until it
  /// returns false. It may put nodes there, and take the piece. Takes the volume, too.
  template <class AtOut>
  bool split_down(Grower& grower, Polyhedron<Vertex>& volume, const AtOut& at_out) const;

  /// All OUT cells, in the order of nodes.
  std::vector<TreePlace> out_cells() const;
  /// Whether no cell is OUT.
  bool is_full() const { return is_full(nodes_[0].front); }
  /// Makes an OUT cell IN, for it is full of the volumes of a tree that graft() will put there.
  void close(TreePlace at);
  /// Puts trees into cells that were OUT, trees[i] at places[i], and empties them.
  void graft(std::span<const TreePlace> places, std::span<VolumeTree> trees);

  std::uint64_t node_count() const { return nodes_.size() - 1; }
  /// Nodes on the longest way from the root to a cell. O(nodes).
  std::uint64_t depth() const { return depth_of(std::span<const Node>(nodes_)); }
  /// The node at a place, or a negative number that stands for a cell.
  std::int32_t node_at(TreePlace at) const {
    return at.front ? nodes_[at.node].front : nodes_[at.node].back;
  }
  PlaneRef plane(std::uint32_t node) const { return nodes_[node].plane; }
  /// Whose volume covers the cell at a place; kNoCaster if it is OUT.
  std::uint32_t caster_at(TreePlace at) const {
    const std::int32_t cell = node_at(at);
    return cell == kOut ? Fragment::kNoCaster : static_cast<std::uint32_t>(-2 - cell);
  }

 private:
  // Cells are encoded in the child links.
  static constexpr std::int32_t kOut = -1;
  static constexpr std::int32_t in_cell(std::uint32_t caster) {
    return -2 - static_cast<std::int32_t>(caster);
  }
  struct Node {
    PlaneRef plane;
    std::int32_t front = kOut, back = kOut;
    std::uint32_t parent : 31 = 0;
    std::uint32_t full : 1 = 0;  // no cell below it is OUT, and so none is extended
  };

  std::int32_t& child(TreePlace at) {
    return at.front ? nodes_[at.node].front : nodes_[at.node].back;
  }
  bool is_full(std::int32_t link) const {
    return link < 0 ? link != kOut : nodes_[static_cast<std::size_t>(link)].full != 0;
  }
  void note_full(std::uint32_t node);
  void split(Grower& grower, std::uint32_t node, std::size_t top) const;
  void extend(TreePlace at, const Polyhedron<Vertex>& piece, PlaneId base, std::uint32_t caster);

  Rules rules_;
  std::vector<Node> nodes_;  // 0 is a sentinel whose front child is the root
};

/// CellFilter filters loops down finished trees. Each thread has one, with its own fork of the
/// space that the trees grew in.
template <VolumeSpaceModel Space>
class CellFilter {
 public:
  using Vertex = typename Space::Vertex;
  using Tree = VolumeTree<Space>;

  CellFilter(Space& space, bool merge_siblings) : space_(&space), filter_(merge_siblings) {}

  /// Appends the fragments of a loop, each with its cell.
  void filter(const Tree& tree, const LoopView<Vertex>& loop,
              const ReceivingSide<Vertex>& receiving, CellOutput<Vertex>& output) {
    filter_.filter(*space_, Cells{*space_, tree, receiving, output}, loop, output);
  }

  /// Children with fewer than three vertices that were dropped: 0 on exact kernels.
  std::uint64_t vanished() const { return filter_.vanished(); }

 private:
  struct Cells;  // what PlaneTreeFilter asks of a tree while it filters one loop

  Space* space_;
  PlaneTreeFilter<Space> filter_;
};

/// VolumeTreeWorkspace is what one thread needs to filter receivers.
template <VolumeSpaceModel Space>
struct VolumeTreeWorkspace {
  VolumeTreeWorkspace(Space& space, bool merge) : filter(space, merge) {}
  CellFilter<Space> filter;
  CellOutput<typename Space::Vertex> penumbra, umbra;
  LoopStore<typename Space::Vertex> front;
};

template <VolumeSpaceModel Space>
void VolumeTree<Space>::plant(Space& space, const SpacePrefix& prefix) {
  if (prefix.nodes.empty()) return;
  const auto link = [](std::int32_t planned) {
    return planned == SpacePrefix::kLeaf ? kOut : planned + 1;  // after the sentinel
  };
  for (const SpacePrefix::Node& planned : prefix.nodes) {
    nodes_.push_back({space.add_axis_plane(planned.axis, planned.value), link(planned.front),
                      link(planned.back), 0, 0});
  }
  nodes_[0].front = 1;
  for (std::uint32_t node = 1; node < nodes_.size(); ++node) {
    for (const std::int32_t link : {nodes_[node].front, nodes_[node].back}) {
      if (link >= 0) nodes_[static_cast<std::size_t>(link)].parent = node;
    }
  }
}

template <VolumeSpaceModel Space>
bool VolumeTree<Space>::insert(Grower& grower, Polyhedron<Vertex>& volume, PlaneId base,
                               std::uint32_t caster, std::uint64_t most_nodes) {
  return split_down(grower, volume, [&](TreePlace at, const Polyhedron<Vertex>& piece) {
    extend(at, piece, base, caster);
    return node_count() <= most_nodes;
  });
}

template <VolumeSpaceModel Space>
template <class AtOut>
bool VolumeTree<Space>::split_down(Grower& grower, Polyhedron<Vertex>& volume,
                                   const AtOut& at_out) const {
  if (volume.empty()) return true;
  grower.places.assign(1, TreePlace{});
  std::swap(grower.piece(0), volume);
  while (!grower.places.empty()) {
    const std::size_t top = grower.places.size() - 1;
    TreePlace at = grower.places.back();
    grower.places.pop_back();
    const std::int32_t node = descend(
        at,
        [&](TreePlace place) {
          const std::int32_t link = node_at(place);
          return link >= 0 && nodes_[static_cast<std::size_t>(link)].full != 0 ? kNoNode : link;
        },
        [&](std::uint32_t number) {
          return grower.splitter.decide(*grower.space, nodes_[number].plane, grower.piece(top));
        });
    if (node >= 0) {
      split(grower, static_cast<std::uint32_t>(node), top);
    } else if (node_at(at) == kOut && !at_out(at, grower.piece(top))) {
      return false;
    }
  }
  return true;
}

/// Puts what a node's plane makes of piece `top`, which is no longer needed, where it goes next.
template <VolumeSpaceModel Space>
void VolumeTree<Space>::split(Grower& grower, std::uint32_t node, std::size_t top) const {
  std::swap(grower.whole, grower.piece(top));
  grower.piece(top + 1);
  Polyhedron<Vertex>&back = grower.pieces[top], &front = grower.pieces[top + 1];
  // The back child is taken last: a chain of back children is then walked with a short stack.
  grower.splitter.split(*grower.space, nodes_[node].plane, grower.whole, front, back);
  if (!back.empty()) grower.places.push_back({node, false});
  if (!front.empty()) {
    if (back.empty()) std::swap(back, front);
    grower.places.push_back({node, true});
  }
}

template <VolumeSpaceModel Space>
void VolumeTree<Space>::extend(TreePlace at, const Polyhedron<Vertex>& piece, PlaneId base,
                               std::uint32_t caster) {
  // Else only cells that the caster itself reaches are extended (1992, fig. 6).
  if (!rules_.volumes_continue_behind_others &&
      std::none_of(piece.faces.begin(), piece.faces.end(), [&](const PolyhedronFace& face) {
        return face.own && face.plane.index() == base;
      })) {
    return;
  }
  for (const PolyhedronFace& face : piece.faces) {
    if (!face.own) continue;
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({face.plane, kOut, kOut, at.node & 0x7fffffffu, 0});
    child(at) = static_cast<std::int32_t>(node);
    at = {node, true};
  }
  child(at) = in_cell(caster);
  note_full(at.node);
}

template <VolumeSpaceModel Space>
void VolumeTree<Space>::note_full(std::uint32_t node) {
  for (; node != 0 && is_full(nodes_[node].front) && is_full(nodes_[node].back);
       node = nodes_[node].parent) {
    nodes_[node].full = 1;
  }
}

template <VolumeSpaceModel Space>
std::vector<TreePlace> VolumeTree<Space>::out_cells() const {
  std::vector<TreePlace> cells;
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (nodes_[node].front == kOut) cells.push_back({node, true});
    if (node > 0 && nodes_[node].back == kOut) cells.push_back({node, false});  // 0: the sentinel
  }
  return cells;
}

template <VolumeSpaceModel Space>
void VolumeTree<Space>::close(TreePlace at) {
  child(at) = in_cell(0);
  note_full(at.node);
}

template <VolumeSpaceModel Space>
void VolumeTree<Space>::graft(std::span<const TreePlace> places, std::span<VolumeTree> trees) {
  std::size_t nodes = nodes_.size();
  for (const VolumeTree& tree : trees) nodes += tree.node_count();
  nodes_.reserve(nodes);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const auto offset = static_cast<std::int32_t>(nodes_.size()) - 1;  // of a tree's node 1
    const auto link = [&](std::int32_t own) { return own < 0 ? own : own + offset; };
    const std::vector<Node> own = std::exchange(trees[i].nodes_, std::vector<Node>(1));
    child(places[i]) = link(own[0].front);
    for (std::size_t k = 1; k < own.size(); ++k) {
      Node node = own[k];
      node.front = link(node.front);
      node.back = link(node.back);
      node.parent = node.parent == 0
                        ? places[i].node & 0x7fffffffu
                        : (node.parent + static_cast<std::uint32_t>(offset)) & 0x7fffffffu;
      nodes_.push_back(node);
    }
    note_full(places[i].node);
  }
}

template <VolumeSpaceModel Space>
struct CellFilter<Space>::Cells {
  Space& space;
  const Tree& tree;
  const ReceivingSide<Vertex>& receiving;
  CellOutput<Vertex>& output;

  std::int32_t node_at(TreePlace at) const { return tree.node_at(at); }
  PlaneRef plane(std::uint32_t node, const LoopView<Vertex>&) const { return tree.plane(node); }
  Placement placement(SplitRecord& record, std::uint32_t node, const LoopView<Vertex>& loop) const {
    const PlaneRef plane = tree.plane(node);
    if (plane.same_plane(receiving.plane)) {
      return plane == receiving.plane ? Placement::kFront : Placement::kBack;
    }
    const Placement placement = record.decide(space, plane, loop);
    if (placement != Placement::kOn) return placement;
    // The node's plane is the receiver's under another name, or rounding flattens the loop.
    return space.side_of_plane(plane, *receiving.before) == Side::kFront ? Placement::kFront
                                                                         : Placement::kBack;
  }
  bool is_kept(const LoopView<Vertex>&) const { return true; }
  void at_cell(TreePlace at, const LoopView<Vertex>& fragment) const {
    output.fragments.push_back({output.loops.append(fragment), tree.caster_at(at)});
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_VOLUME_TREE_H
