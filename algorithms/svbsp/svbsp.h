// SPDX-License-Identifier: LGPL-3.0-or-later
// The shadow volume BSP tree (Chin & Feiner 1989, sec. 4): filter each polygon, front to back as
// seen from the light, down the tree of shadow planes; what reaches an IN cell is in shadow, what
// reaches an OUT cell is lit, and its shadow volume is added there.
//
// A front child is inside the node's plane. The tree starts as the balanced prefix. An IN cell
// knows the part whose fragment made it: that part shadows everything in the cell, the witness of
// the fragment. A fragment is bounded by the planes of its ancestors already, so only edges that
// the fragment brought with it become nodes: the planes that cut it stand above it in the tree. (A
// rounded kernel without identity does not know that, and makes a plane of every edge.)
//
// The tree is permanent: each node and each IN cell knows the group of polygons at which it was
// made, so that a finished tree classifies a loop of any group as the tree of that time did. A cell
// has a record of its own, since a fragment may turn one IN without adding a node.
//
// Guarantee on exact kernels: polygons given front to back, coplanar ones filtered before any of
// them is inserted, every fragment has the class of the definition (docs: semantics). Explicit
// stacks.
#ifndef GNOMON_ALGORITHMS_SVBSP_SVBSP_H
#define GNOMON_ALGORITHMS_SVBSP_SVBSP_H

#include <cstdint>
#include <vector>

#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/plane_tree_filter.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "algorithms/svbsp/in_out_tree.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// FilterActions says what filtering does with a polygon.
struct FilterActions {
  bool classify = true;  // append fragments to the output
  bool insert = true;    // add the shadow volumes of lit fragments to the tree
};

/// What a tree is made of, where no class depends on it.
struct TreeChoice {
  bool merge_siblings = true;
  EdgesInTree edges = EdgesInTree::kOwn;
  /// Edges below this are the scene's; others were made by splits of the scene BSP.
  std::uint32_t scene_edges = 0xffffffffu;
};

template <LightSpaceModel Space>
class SvbspTree {
 public:
  using Vertex = typename Space::Vertex;

  SvbspTree(Space& space, const TreeChoice& choice, const Rules& rules = {});

  /// Puts the balanced prefix at the top. Requires: nothing inserted yet.
  void plant(const PrefixTree& prefix) { plant_prefix(*space_, prefix, nodes_); }

  /// What is inserted from now on is made at the next group.
  void begin_group() { ++group_; }
  /// Filters a loop that is counter-clockwise seen from the light.
  void filter(const LoopView<Vertex>& loop, FilterActions actions, ClassifiedLoops<Vertex>& output);
  /// Appends the fragments of a loop of a group, 1, 2, ..., as they were before anything of that
  /// group or a later one was inserted.
  void classify(const LoopView<Vertex>& loop, std::uint32_t group, ClassifiedLoops<Vertex>& output);

  std::uint64_t node_count() const { return nodes_.size() - 1; }
  /// Nodes on the longest way from the root to a cell. O(nodes).
  std::uint64_t depth() const { return most_of(depths_of(std::span<const Node>(nodes_))); }
  /// Nodes one below another, each the only child of the one before it. O(nodes).
  std::uint64_t longest_chain() const { return longest_chain_of(std::span<const Node>(nodes_)); }
  /// Nodes above the cells that loops came to, on average; in millionths. O(nodes).
  std::uint64_t mean_filter_depth() const;
  /// Children with fewer than three vertices that were dropped (rounded kernels).
  std::uint64_t vanished() const { return filter_.vanished(); }
  /// Memory of nodes and cells.
  std::uint64_t bytes() const {
    return nodes_.size() * sizeof(Node) + cells_.size() * sizeof(InCell);
  }

 private:
  static constexpr std::uint32_t kAnyGroup = 0xffffffffu;
  struct Node {
    PlaneRef plane;
    std::int32_t front = kOutCell, back = kOutCell;
    std::uint32_t group = 0;  // 0: the prefix
  };
  /// A link in_cell(i) stands for cells_[i].
  struct InCell {
    std::uint32_t caster = 0, group = 0;
  };
  struct Cells;  // what PlaneTreeFilter asks of this tree while it filters one polygon

  std::int32_t& child(TreePlace at) {
    return at.front ? nodes_[at.node].front : nodes_[at.node].back;
  }
  void insert(TreePlace at, const LoopView<Vertex>& fragment, const LoopView<Vertex>& original);

  Space* space_;
  TreeChoice choice_;
  Rules rules_;
  std::vector<std::uint64_t> visits_;  // by node: loops that came to a cell below it
  std::vector<Node> nodes_;            // 0 is a sentinel whose front child is the root
  std::vector<InCell> cells_;
  std::uint32_t group_ = 0;
  PlaneTreeFilter<Space> filter_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_SVBSP_H
