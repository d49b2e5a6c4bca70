// SPDX-License-Identifier: LGPL-3.0-or-later
// The walk of a convex loop down a tree of oriented planes, which the SVBSP tree (Chin & Feiner
// 1989, sec. 4) and the trees of shadow volumes (1992) have in common: a loop goes to the side of
// each plane that it lies on, and is split where it lies on both; what reaches a cell is put out;
// and where both children of a split come out whole and alike, their parent is put out instead
// (1989, sec. 6).
//
// What differs is the tree's own: what its cells are, what happens in them, which loops are alike,
// and where a loop belongs that lies in a plane. Explicit stack.
#ifndef GNOMON_ALGORITHMS_PARTITION_PLANE_TREE_FILTER_H
#define GNOMON_ALGORITHMS_PARTITION_PLANE_TREE_FILTER_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/split.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// A child link of a node: a cell, or the root of a subtree, is there.
struct TreePlace {
  std::uint32_t node = 0;
  bool front = true;
};

/// A child link that no node is behind.
inline constexpr std::int32_t kNoNode = -1;

/// Goes down from `at` for as long as `placement_at(node)` has what is filtered on one side of the
/// node's plane. Returns the node whose plane splits it, or kNoNode if `at` is a link that
/// `node_at` does not follow. `node_at(place)`: a node, or a negative number.
template <class NodeAt, class PlacementAt>
inline std::int32_t descend(TreePlace& at, const NodeAt& node_at, const PlacementAt& placement_at) {
  for (;;) {
    const std::int32_t link = node_at(at);
    if (link < 0) return kNoNode;
    const auto node = static_cast<std::uint32_t>(link);
    switch (placement_at(node)) {
      case Placement::kOn:  // only where rounding flattens all of it
      case Placement::kFront:
        at = {node, true};
        break;
      case Placement::kBack:
        at = {node, false};
        break;
      case Placement::kSpanning:
        return link;
    }
  }
}

/// For each node how many there are on the way from the root, which nodes[0] stands for and does
/// not count as, to it; links to nodes are not negative. Requires: a node comes after its parent.
/// O(nodes).
template <class Node>
std::vector<std::uint32_t> depths_of(std::span<const Node> nodes) {
  std::vector<std::uint32_t> depth(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const std::int32_t link : {nodes[i].front, nodes[i].back}) {
      if (link >= 0) depth[static_cast<std::size_t>(link)] = depth[i] + 1;
    }
  }
  return depth;
}
inline std::uint64_t most_of(const std::vector<std::uint32_t>& depths) {
  return *std::max_element(depths.begin(), depths.end());
}
/// The depth of the tree.
template <class Node>
std::uint64_t depth_of(std::span<const Node> nodes) {
  return most_of(depths_of(nodes));
}

/// Nodes one below another, each the only one below the one before it. Requires and cost: as
/// depths_of().
template <class Node>
std::uint64_t longest_chain_of(std::span<const Node> nodes) {
  std::vector<std::uint32_t> chain(nodes.size(), 1);  // that ends in the node
  std::uint32_t most = nodes.size() > 1 ? 1 : 0;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if ((nodes[i].front >= 0) == (nodes[i].back >= 0)) continue;
    const auto only = static_cast<std::size_t>(std::max(nodes[i].front, nodes[i].back));
    chain[only] = chain[i] + 1;
    most = std::max(most, chain[only]);
  }
  return most;
}

/// PlaneTreeFilter does the walk, and keeps its workspace.
template <DecisionSpace Space>
class PlaneTreeFilter {
 public:
  using Vertex = typename Space::Vertex;

  explicit PlaneTreeFilter(bool merge_siblings) : merge_siblings_(merge_siblings) {}

  /// Takes the loop to the cells of `tree`, which has
  ///   node_at(place): the node there, or a negative number that stands for a cell;
  ///   placement(record, node, loop): where a loop belongs that meets the node, from a record of
  ///   its sides;
  ///   plane(node, loop): the plane that splits it;
  ///   is_kept(loop): whether a child with three or more vertices is filtered further;
  ///   at_cell(place, loop): puts out a loop that has reached a cell, and may extend the tree.
  template <class Tree, class CellLoop>
  void filter(Space& space, Tree&& tree, const LoopView<Vertex>& loop,
              FilteredLoops<Vertex, CellLoop>& output) {
    const PlaneId support = loop.support;
    stack_.clear();
    work_.clear();
    stack_.push_back({{}, false, work_.append(loop), 0});
    while (!stack_.empty()) {
      Frame frame = stack_.back();
      stack_.pop_back();
      if (frame.leaving) {
        if (merge_siblings_) merge(frame, support, output);
        work_.truncate(frame.loop.first);
        continue;
      }
      const LoopView<Vertex> here = work_.view(frame.loop, support);
      const std::int32_t node = descend(
          frame.at, [&](TreePlace at) { return tree.node_at(at); },
          [&](std::uint32_t at) { return tree.placement(record_, at, here); });
      if (node >= 0) {
        frame.leaving = true;
        frame.first_output = static_cast<std::uint32_t>(output.fragments.size());
        stack_.push_back(frame);
        split(space, tree, static_cast<std::uint32_t>(node), frame.loop, support);
      } else {
        tree.at_cell(frame.at, here);
        work_.truncate(frame.loop.first);
      }
    }
  }

  /// Children with fewer than three vertices that were dropped (rounded kernels).
  std::uint64_t vanished() const { return vanished_; }

 private:
  struct Frame {
    TreePlace at;
    bool leaving = false;            // the children are done: merge them, drop the loop
    LoopRange loop;                  // in work_
    std::uint32_t first_output = 0;  // when leaving: how many fragments came before the children's
  };

  /// Puts the children of a loop on the stack.
  template <class Tree>
  void split(Space& space, const Tree& tree, std::uint32_t node, const LoopRange& loop,
             PlaneId support) {
    parent_.clear();
    const LoopRange copy = parent_.append(work_.view(loop, support));
    const LoopView<Vertex> parent = parent_.view(copy, support);
    const SplitChildren children =
        make_children(space, tree.plane(node, parent), parent, record_, crossings_, work_);
    // The front child was appended last and is taken first, so that the loops are a stack.
    for (const bool front : {false, true}) {
      const LoopRange& child = front ? children.front : children.back;
      if (child.count >= 3 && tree.is_kept(work_.view(child, support))) {
        stack_.push_back({{node, front}, false, child, 0});
      } else {
        ++vanished_;
      }
    }
  }

  /// Two fragments that are alike, and are all that became of a loop, are that loop again.
  template <class CellLoop>
  void merge(const Frame& frame, PlaneId support, FilteredLoops<Vertex, CellLoop>& output) {
    if (output.fragments.size() != frame.first_output + std::size_t{2}) return;
    CellLoop& first = output.fragments[frame.first_output];
    if (!first.is_like(output.fragments.back())) return;
    // The two loops are the last in the output: the whole they were cut from takes their place.
    output.loops.truncate(first.loop.first);
    first.loop = output.loops.append(work_.view(frame.loop, support));
    output.fragments.pop_back();
  }

  bool merge_siblings_;
  std::uint64_t vanished_ = 0;
  std::vector<Frame> stack_;
  LoopStore<Vertex> work_, parent_;
  SplitRecord record_;
  std::vector<Vertex> crossings_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_PLANE_TREE_FILTER_H
