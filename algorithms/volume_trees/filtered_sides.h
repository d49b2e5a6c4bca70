// SPDX-License-Identifier: LGPL-3.0-or-later
// Fragments of sides of parts that went down a light's trees piece by piece, until all pieces of
// them are there.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_FILTERED_SIDES_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_FILTERED_SIDES_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/piece_class.h"
#include "gnomon/kernel/sign.h"

namespace gnomon {

template <class Vertex>
class FilteredSides {
 public:
  /// From now on such a side is one of them.
  void take(std::uint32_t part, Side side) {
    const std::size_t number = number_of(part, side);
    if (sides_.size() <= number) sides_.resize(number + 1);
    sides_[number].is_there = true;
  }
  bool has(std::uint32_t part, Side side) const {
    const std::size_t number = number_of(part, side);
    return number < sides_.size() && sides_[number].is_there;
  }
  /// Requires: has().
  void add(std::uint32_t part, Side side, const PieceClass& state, const LoopView<Vertex>& loop) {
    sides_[number_of(part, side)].pieces.push_back({state, loops_.append(loop)});
  }
  /// Calls emit(PieceClass, Loop) for each fragment of a side, in the order in which they came,
  /// until it returns false. `support`: of the part.
  template <class Emit>
  void for_each(std::uint32_t part, Side side, PlaneId support, const Emit& emit) const {
    for (const Piece& piece : sides_[number_of(part, side)].pieces) {
      if (!emit(piece.state, loops_.view(piece.loop, support))) return;
    }
  }

 private:
  struct Piece {
    PieceClass state;
    LoopRange loop;
  };
  struct SidePieces {
    bool is_there = false;
    std::vector<Piece> pieces;
  };
  static std::size_t number_of(std::uint32_t part, Side side) {
    return 2 * std::size_t{part} + (side == Side::kBack ? 1 : 0);
  }

  LoopStore<Vertex> loops_;
  std::vector<SidePieces> sides_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_FILTERED_SIDES_H
