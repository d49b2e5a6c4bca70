// SPDX-License-Identifier: LGPL-3.0-or-later
// A tree of volumes while it grows cell by cell: below each cell of its prefix stands a tree of its
// own, so that cells may be grown by several threads at the same time.
//
// Guarantee: if each cell gets the same pieces in the same order, the tree is the same whoever grew
// which cell, and it is the one that VolumeTree::insert() would make of the whole volumes, but for
// the numbers of its nodes: pieces in different cells know nothing of each other.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_CELLS_OF_TREE_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_CELLS_OF_TREE_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/partition/plane_tree_filter.h"
#include "algorithms/partition/rules.h"
#include "algorithms/volume_trees/polyhedron.h"
#include "algorithms/volume_trees/volume_tree.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

template <VolumeSpaceModel Space>
class CellsOfTree {
 public:
  using Vertex = typename Space::Vertex;
  using Grower = TreeGrower<Space>;

  /// `whole`: has its prefix and no volume, and must outlive the cells.
  CellsOfTree(VolumeTree<Space>& whole, const Rules& rules)
      : whole_(&whole),
        places_(whole.out_cells()),
        trees_(places_.size(), VolumeTree<Space>(rules)),
        closed_(places_.size(), false),
        numbers_(2 * (whole.node_count() + 1)),
        nodes_(whole.node_count()) {
    for (std::uint32_t i = 0; i < places_.size(); ++i) numbers_[key(places_[i])] = i;
  }

  std::size_t size() const { return places_.size(); }
  /// Calls at_cell(cell, piece) for each piece of a volume in a cell that is not closed, until it
  /// returns false; takes the volume, as VolumeTree::split_down does.
  template <class AtCell>
  bool split_down(Grower& grower, Polyhedron<Vertex>& volume, const AtCell& at_cell) const {
    return whole_->split_down(grower, volume, [&](TreePlace at, Polyhedron<Vertex>& piece) {
      return at_cell(numbers_[key(at)], piece);
    });
  }
  /// Adds a piece, and takes it. Threads may do so at the same time, one a cell. False if all cells
  /// together have more than `most_nodes`.
  bool insert(Grower& grower, std::uint32_t cell, Polyhedron<Vertex>& piece, PlaneId base,
              std::uint32_t caster, std::uint64_t most_nodes) {
    VolumeTree<Space>& tree = trees_[cell];
    const std::uint64_t before = tree.node_count();
    if (!tree.insert(grower, piece, base, caster, most_nodes)) return false;
    const std::uint64_t more = tree.node_count() - before;
    return nodes_.fetch_add(more, std::memory_order_relaxed) + more <= most_nodes;
  }
  /// From now on no pieces go to cells that are full.
  void close_full() {
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      if (closed_[i] || !trees_[i].is_full()) continue;
      closed_[i] = true;
      whole_->close(places_[i]);
    }
  }
  /// Puts all cells into the tree, after which there is nothing left here.
  void finish() { whole_->graft(places_, trees_); }

 private:
  static std::size_t key(TreePlace at) { return 2 * std::size_t{at.node} + (at.front ? 1 : 0); }

  VolumeTree<Space>* whole_;
  std::vector<TreePlace> places_;
  std::vector<VolumeTree<Space>> trees_;  // by cell
  std::vector<bool> closed_;
  std::vector<std::uint32_t> numbers_;  // of cells, by the key of their place
  std::atomic<std::uint64_t> nodes_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_CELLS_OF_TREE_H
