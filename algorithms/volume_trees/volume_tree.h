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
#include <utility>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "algorithms/volume_trees/balanced_prefix.h"
#include "algorithms/volume_trees/polyhedron.h"
#include "gnomon/algorithms/shadow_result.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// A convex loop that one cell holds.
struct CellLoop {
  LoopRange loop;                              // in CellOutput::loops
  std::uint32_t caster = Fragment::kNoCaster;  // kNoCaster: OUT
};

template <class Vertex>
struct CellOutput {
  LoopStore<Vertex> loops;
  std::vector<CellLoop> cells;
  void clear() {
    loops.clear();
    cells.clear();
  }
};

/// Where the receiving side of a loop is: what lies *in* a node's plane belongs to the cell just in
/// front of the receiver (docs: semantics, the class is that limit).
template <class Vertex>
struct ReceivingSide {
  PlaneRef plane;                // of the loop, receiving side in front
  const Corner<Vertex>* before;  // some point strictly in front of it: a vertex of the light
};

template <VolumeSpaceModel Space>
class CellFilter;

template <VolumeSpaceModel Space>
class VolumeTree {
 public:
  using Vertex = typename Space::Vertex;

  explicit VolumeTree(Space& space, const Rules& rules = {})
      : space_(&space), rules_(rules), nodes_(1) {}

  /// Puts a balanced prefix at the top. Requires: nothing inserted yet.
  void plant(const SpacePrefix& prefix);

  /// The union with a volume. `base`: the caster's plane. Returns false, and leaves the tree in an
  /// undefined state, if it would have more than `most_nodes`.
  bool insert(const Polyhedron<Vertex>& volume, PlaneId base, std::uint32_t caster,
              std::uint64_t most_nodes);

  std::uint64_t node_count() const { return nodes_.size() - 1; }
  /// What could not be made as it should: 0 on exact kernels.
  std::uint64_t findings() const { return splitter_.findings(); }

 private:
  friend class CellFilter<Space>;
  // Cells are encoded in the child links.
  static constexpr std::int32_t kOut = -1;
  static constexpr std::int32_t kUnused = -2;  // no receiver: nothing will ever be asked here
  static constexpr std::int32_t in_cell(std::uint32_t caster) {
    return -3 - static_cast<std::int32_t>(caster);
  }
  static constexpr std::uint32_t caster_of(std::int32_t cell) {
    return cell > -3 ? Fragment::kNoCaster : static_cast<std::uint32_t>(-3 - cell);
  }
  struct Node {
    PlaneRef plane;
    std::int32_t front = kOut, back = kOut;
    std::uint32_t parent : 31 = 0;
    std::uint32_t full : 1 = 0;  // no OUT cell below: nothing to extend any more
  };
  struct Place {
    std::uint32_t node = 0;  // the cell or subtree is this node's front or back child
    bool front = true;
  };

  std::int32_t& child(Place at) { return at.front ? nodes_[at.node].front : nodes_[at.node].back; }
  std::int32_t child(Place at) const {
    return at.front ? nodes_[at.node].front : nodes_[at.node].back;
  }
  bool is_full(std::int32_t link) const {
    return link < 0 ? link != kOut : nodes_[static_cast<std::size_t>(link)].full != 0;
  }
  void note_full(std::uint32_t node);
  void extend(Place at, const Polyhedron<Vertex>& piece, PlaneId base, std::uint32_t caster);

  Space* space_;
  Rules rules_;
  std::vector<Node> nodes_;  // 0 is a sentinel whose front child is the root
  // Workspace of insert(): places_[i] is where pieces_[i] goes, i < places_.size().
  PolyhedronSplitter<Space> splitter_;
  std::vector<Place> places_;
  std::vector<Polyhedron<Vertex>> pieces_;
  Polyhedron<Vertex> whole_;
};

/// Filters loops down finished trees. One for each thread, with its own fork of the space that the
/// trees grew in.
template <VolumeSpaceModel Space>
class CellFilter {
 public:
  using Vertex = typename Space::Vertex;
  using Tree = VolumeTree<Space>;

  CellFilter(Space& space, bool merge_siblings) : space_(&space), merge_siblings_(merge_siblings) {}

  /// Appends the pieces of a loop, each with its cell.
  void filter(const Tree& tree, const LoopView<Vertex>& loop,
              const ReceivingSide<Vertex>& receiving, CellOutput<Vertex>& output);

  /// Children with fewer than three vertices that were dropped: 0 on exact kernels.
  std::uint64_t vanished() const { return vanished_; }

 private:
  struct Frame {
    typename Tree::Place at;
    bool leaving = false;          // children done: merge, drop the loop
    LoopRange loop;                // in work_
    std::size_t first_output = 0;  // when leaving: outputs before the children's
  };

  Placement place(PlaneRef plane, const LoopView<Vertex>& loop,
                  const ReceivingSide<Vertex>& receiving);
  void try_merge(const Frame& frame, PlaneId support, CellOutput<Vertex>& output);

  Space* space_;
  bool merge_siblings_;
  std::uint64_t vanished_ = 0;
  std::vector<Frame> stack_;
  LoopStore<Vertex> work_, parent_;
  SplitRecord record_;
  std::vector<Vertex> crossings_;
};

/// What one thread needs to filter receivers.
template <VolumeSpaceModel Space>
struct VolumeTreeWorkspace {
  VolumeTreeWorkspace(Space& space, bool merge) : filter(space, merge) {}
  CellFilter<Space> filter;
  CellOutput<typename Space::Vertex> penumbra, umbra;
  LoopStore<typename Space::Vertex> front;
};

template <VolumeSpaceModel Space>
void VolumeTree<Space>::plant(const SpacePrefix& prefix) {
  if (prefix.nodes.empty()) return;
  const auto link = [](std::int32_t planned) {
    return planned == SpacePrefix::kLeaf     ? kOut
           : planned == SpacePrefix::kUnused ? kUnused
                                             : planned + 1;  // after the sentinel
  };
  for (const SpacePrefix::Node& planned : prefix.nodes) {
    nodes_.push_back({space_->add_axis_plane(planned.axis, planned.value), link(planned.front),
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
bool VolumeTree<Space>::insert(const Polyhedron<Vertex>& volume, PlaneId base, std::uint32_t caster,
                               std::uint64_t most_nodes) {
  if (volume.empty()) return true;
  const auto piece = [&](std::size_t i) -> Polyhedron<Vertex>& {
    if (pieces_.size() <= i) pieces_.resize(i + 1);
    return pieces_[i];
  };
  places_.assign(1, Place{});
  piece(0) = volume;
  while (!places_.empty()) {
    const std::size_t top = places_.size() - 1;
    Place at = places_.back();
    places_.pop_back();
    // Down while the piece is whole.
    bool split = false;
    while (!split && child(at) >= 0) {
      const auto node = static_cast<std::uint32_t>(child(at));
      if (nodes_[node].full != 0) break;
      const PlaneRef plane = nodes_[node].plane;
      switch (splitter_.decide(*space_, plane, piece(top))) {
        case Placement::kOn:  // only where rounding flattens a whole piece
        case Placement::kFront:
          at = {node, true};
          break;
        case Placement::kBack:
          at = {node, false};
          break;
        case Placement::kSpanning: {
          split = true;
          std::swap(whole_, piece(top));
          piece(top + 1);
          // What is outside goes last: a chain of outsides is then walked with a short stack.
          splitter_.split(*space_, plane, whole_, pieces_[top + 1], pieces_[top]);
          if (!pieces_[top].empty()) places_.push_back({node, false});
          if (!pieces_[top + 1].empty()) {
            if (pieces_[top].empty()) std::swap(pieces_[top], pieces_[top + 1]);
            places_.push_back({node, true});
          }
          break;
        }
      }
    }
    if (split || child(at) != kOut) continue;
    extend(at, piece(top), base, caster);
    if (node_count() > most_nodes) return false;
  }
  return true;
}

template <VolumeSpaceModel Space>
void VolumeTree<Space>::extend(Place at, const Polyhedron<Vertex>& piece, PlaneId base,
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
Placement CellFilter<Space>::place(PlaneRef plane, const LoopView<Vertex>& loop,
                                   const ReceivingSide<Vertex>& receiving) {
  if (!plane.same_plane(receiving.plane)) {
    const Placement placement = record_.decide(*space_, plane, loop);
    if (placement != Placement::kOn) return placement;
    // The node's plane is the receiver's under another name, or rounding flattens the loop.
    return space_->side_of_plane(plane, *receiving.before) == Side::kFront ? Placement::kFront
                                                                           : Placement::kBack;
  }
  return plane == receiving.plane ? Placement::kFront : Placement::kBack;
}

template <VolumeSpaceModel Space>
void CellFilter<Space>::filter(const Tree& tree, const LoopView<Vertex>& loop,
                               const ReceivingSide<Vertex>& receiving, CellOutput<Vertex>& output) {
  stack_.clear();
  work_.clear();
  const PlaneId support = loop.support;
  stack_.push_back({{}, false, work_.append(loop), 0});
  while (!stack_.empty()) {
    Frame frame = stack_.back();
    stack_.pop_back();
    if (frame.leaving) {
      try_merge(frame, support, output);
      work_.truncate(frame.loop.first);
      continue;
    }
    bool split = false;
    while (!split && tree.child(frame.at) >= 0) {
      const auto node = static_cast<std::uint32_t>(tree.child(frame.at));
      const PlaneRef plane = tree.nodes_[node].plane;
      switch (place(plane, work_.view(frame.loop, support), receiving)) {
        case Placement::kOn:
        case Placement::kFront:
          frame.at = {node, true};
          break;
        case Placement::kBack:
          frame.at = {node, false};
          break;
        case Placement::kSpanning: {
          split = true;
          parent_.clear();
          const LoopRange copy = parent_.append(work_.view(frame.loop, support));
          frame.leaving = true;
          frame.first_output = output.cells.size();
          stack_.push_back(frame);
          const SplitChildren children = make_children(*space_, plane, parent_.view(copy, support),
                                                       record_, crossings_, work_);
          // The front child was appended last and is taken first, so that the loops are a stack.
          if (children.back.count >= 3) {
            stack_.push_back({{node, false}, false, children.back, 0});
          } else {
            ++vanished_;
          }
          if (children.front.count >= 3) {
            stack_.push_back({{node, true}, false, children.front, 0});
          } else {
            ++vanished_;
          }
          break;
        }
      }
    }
    if (split) continue;
    output.cells.push_back({output.loops.append(work_.view(frame.loop, support)),
                            Tree::caster_of(tree.child(frame.at))});
    work_.truncate(frame.loop.first);
  }
}

template <VolumeSpaceModel Space>
void CellFilter<Space>::try_merge(const Frame& frame, PlaneId support, CellOutput<Vertex>& output) {
  if (!merge_siblings_ || output.cells.size() != frame.first_output + 2) return;
  CellLoop& first = output.cells[frame.first_output];
  if (first.caster != output.cells.back().caster) return;
  // The two loops are the last in the output: the whole they were cut from takes their place.
  output.loops.truncate(first.loop.first);
  first.loop = output.loops.append(work_.view(frame.loop, support));
  output.cells.pop_back();
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_VOLUME_TREE_H
