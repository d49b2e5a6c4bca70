// SPDX-License-Identifier: LGPL-3.0-or-later
// Casts volumes into the penumbra tree and the umbra tree of a light cell by cell, on one thread or
// on several (1992, "Algorithm"; docs/area-lights.md, "Threads").
//
// Volumes come in rounds. In a round threads first split whole volumes down the prefixes; then each
// cell of a tree takes the pieces that have reached it, in the order of volumes, by one thread. A
// thread alone takes each piece at once, without keeping it. Cells that a round has filled are
// closed at its end and not before. So the trees, and all decisions, are the same for every number
// of threads.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_CAST_IN_CELLS_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_CAST_IN_CELLS_H

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/rules.h"
#include "algorithms/volume_trees/cells_of_tree.h"
#include "algorithms/volume_trees/polyhedron.h"
#include "algorithms/volume_trees/volume_tree.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

enum class CastOutcome : std::uint8_t { kDone, kStopped, kTooManyNodes };

/// A volume that was cut out for one of the trees.
struct VolumeInTree {
  PlaneId base = 0;          // the caster's plane
  std::uint32_t caster = 0;  // part, or solid after the parts
};

template <VolumeSpaceModel Space>
class CastInCells {
 public:
  using Vertex = typename Space::Vertex;
  using Tree = VolumeTree<Space>;
  using Grower = TreeGrower<Space>;

  /// Both trees have their prefix and no volume. `most_nodes`: of each.
  CastInCells(Space& space, Tree& penumbra, Tree& umbra, const Rules& rules,
              std::uint64_t most_nodes)
      : most_nodes_(most_nodes),
        cells_{Cells(penumbra, rules), Cells(umbra, rules)},
        space_(&space),
        alone_(space) {}

  /// Casts volumes in this order, and finishes the trees.
  /// `cut_out(space, splitter, volume, is_umbra, polyhedron)` cuts a volume out of the scene's box,
  /// and tells whose it is; none: it is not in that tree. It, and `stopped()`, may be called by any
  /// thread; `step(share)` by one between rounds. Either stops if it says so. `jobs` other than 1:
  /// on the threads of the arena that the caller is in.
  template <class CutOut, class Step, class Stopped>
  CastOutcome cast(std::span<const std::uint32_t> volumes, unsigned jobs, const CutOut& cut_out,
                   const Step& step, const Stopped& stopped) {
    // A tree of one cell is grown by one thread.
    const bool alone = jobs == 1 || cells_[0].size() + cells_[1].size() < 4;
    for (std::size_t begin = 0; begin < volumes.size(); begin += kRound) {
      if (!step(static_cast<double>(begin) / static_cast<double>(volumes.size()))) {
        return CastOutcome::kStopped;
      }
      const auto round = volumes.subspan(begin, std::min(kRound, volumes.size() - begin));
      if (alone) {
        cast_alone(round, cut_out, stopped);
      } else {
        cast_together(round, cut_out, stopped);
      }
      if (too_many_) return CastOutcome::kTooManyNodes;
      if (stopped()) return CastOutcome::kStopped;
      for (Cells& cells : cells_) cells.close_full();
    }
    for (Cells& cells : cells_) cells.finish();
    return CastOutcome::kDone;
  }

  std::uint64_t findings() const {
    std::uint64_t sum = alone_.findings();
    for (const auto& thread : threads_) sum += thread->worker.findings();
    return sum;
  }
  /// Decisions that forks of the space have made, and the space has not counted.
  StageCounts stage_counts() const {
    StageCounts sum;
    for (const auto& thread : threads_) sum += thread->space.stage_counts();
    return sum;
  }

 private:
  using Cells = CellsOfTree<Space>;
  /// Volumes of a round: enough work for many threads, and few pieces to keep.
  static constexpr std::size_t kRound = 256;

  struct Worker {
    explicit Worker(Space& space) : above(space), below(space) {}
    std::uint64_t findings() const { return above.splitter.findings() + below.splitter.findings(); }

    Grower above, below;  // in the prefix, and in its cells
    Polyhedron<Vertex> volume;
  };
  struct Thread {
    explicit Thread(Space fork) : space(std::move(fork)), worker(space) {}
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    Space space;
    Worker worker;
  };
  struct Piece {
    std::uint32_t cell = 0;
    Polyhedron<Vertex> polyhedron;
  };
  /// The pieces of one volume in one tree.
  struct Pieces {
    VolumeInTree own;
    std::vector<Piece> pieces;  // more than count are kept for their memory
    std::size_t count = 0;
  };
  /// A cell, and the pieces that it has to take.
  struct CellWork {
    std::size_t tree = 0;
    std::uint32_t cell = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pieces;  // a place in pieces_, and there
  };

  template <class CutOut, class Stopped>
  void cast_alone(std::span<const std::uint32_t> volumes, const CutOut& cut_out,
                  const Stopped& stopped) {
    for (const std::uint32_t volume : volumes) {
      if (stopped()) return;
      for (std::size_t tree = 0; tree < cells_.size(); ++tree) {
        const std::optional<VolumeInTree> own =
            cut_out(*space_, alone_.above.splitter, volume, tree == 1, alone_.volume);
        if (!own) continue;
        Cells& cells = cells_[tree];
        const bool fits = cells.split_down(
            alone_.above, alone_.volume, [&](std::uint32_t cell, Polyhedron<Vertex>& piece) {
              return cells.insert(alone_.below, cell, piece, own->base, own->caster, most_nodes_);
            });
        if (fits) continue;
        too_many_ = true;
        return;
      }
    }
  }

  template <class CutOut, class Stopped>
  void cast_together(std::span<const std::uint32_t> volumes, const CutOut& cut_out,
                     const Stopped& stopped) {
    pieces_.resize(2 * kRound);
    tbb::parallel_for(std::size_t{0}, 2 * volumes.size(), [&](std::size_t i) {
      Pieces& pieces = pieces_[i];
      pieces.count = 0;
      if (stopped()) return;
      Thread& thread = this->thread();
      const auto own = cut_out(thread.space, thread.worker.above.splitter, volumes[i / 2],
                               i % 2 == 1, thread.worker.volume);
      if (!own) return;
      pieces.own = *own;
      cells_[i % 2].split_down(thread.worker.above, thread.worker.volume,
                               [&](std::uint32_t cell, Polyhedron<Vertex>& piece) {
                                 if (pieces.count == pieces.pieces.size()) {
                                   pieces.pieces.emplace_back();
                                 }
                                 Piece& kept = pieces.pieces[pieces.count++];
                                 kept.cell = cell;
                                 std::swap(kept.polyhedron, piece);
                                 return true;
                               });
    });
    gather(2 * volumes.size());
    tbb::parallel_for(std::size_t{0}, work_count_, [&](std::size_t i) {
      const CellWork& work = work_[i];
      Thread& thread = this->thread();
      for (const auto& [from, number] : work.pieces) {
        if (too_many_.load(std::memory_order_relaxed) || stopped()) return;
        Pieces& pieces = pieces_[from];
        if (!cells_[work.tree].insert(thread.worker.below, work.cell,
                                      pieces.pieces[number].polyhedron, pieces.own.base,
                                      pieces.own.caster, most_nodes_)) {
          too_many_ = true;
        }
      }
    });
  }

  /// Sorts the pieces of a round by cells; of one cell they stay in the order of volumes.
  void gather(std::size_t count) {
    work_count_ = 0;
    for (std::size_t tree = 0; tree < cells_.size(); ++tree) {
      work_of_[tree].assign(cells_[tree].size(), kNoWork);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t tree = i % 2;
      for (std::size_t k = 0; k < pieces_[i].count; ++k) {
        const std::uint32_t cell = pieces_[i].pieces[k].cell;
        std::uint32_t& number = work_of_[tree][cell];
        if (number == kNoWork) {
          number = static_cast<std::uint32_t>(work_count_++);
          if (work_.size() < work_count_) work_.emplace_back();
          work_[number].tree = tree;
          work_[number].cell = cell;
          work_[number].pieces.clear();
        }
        work_[number].pieces.emplace_back(static_cast<std::uint32_t>(i),
                                          static_cast<std::uint32_t>(k));
      }
    }
  }

  Thread& thread() {
    std::unique_ptr<Thread>& own = threads_.local();
    if (!own) own = std::make_unique<Thread>(space_->fork());
    return *own;
  }

  static constexpr std::uint32_t kNoWork = 0xffffffffu;

  std::uint64_t most_nodes_;
  std::array<Cells, 2> cells_;  // of penumbras, of umbras
  Space* space_;
  Worker alone_;
  tbb::enumerable_thread_specific<std::unique_ptr<Thread>> threads_;
  std::vector<Pieces> pieces_;  // of a round: each volume's penumbra, then its umbra
  std::vector<CellWork> work_;  // its first work_count_ are of the round
  std::size_t work_count_ = 0;
  std::array<std::vector<std::uint32_t>, 2> work_of_;  // by cell, into work_
  std::atomic<bool> too_many_ = false;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_CAST_IN_CELLS_H
