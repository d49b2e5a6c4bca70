// SPDX-License-Identifier: LGPL-3.0-or-later
// The method two-pass in a leaf of the tree of light space: the polygons of the cell clip each
// other (algorithms/two_pass). Without cells there is one leaf, which holds all of them. Bodies of
// sector_tree.h.
#ifndef GNOMON_ALGORITHMS_SECTORS_TWO_PASS_LEAF_H
#define GNOMON_ALGORITHMS_SECTORS_TWO_PASS_LEAF_H

#include <cstdint>
#include <limits>

#include "algorithms/sectors/sector_tree.h"

namespace gnomon {

template <SectorSpaceModel Space>
void SectorTree<Space>::clip_lists(std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t loops_mark = loops_.size(), planes_mark = space_.plane_mark();
  list_pieces(begin, end);
  lists_.run(
      list_setting(), pieces_, [&](PlaneRef edge) { return is_cell_plane(edge); },
      [&] { return stopped(); }, clipped_);
  output_.vanished += lists_.take_vanished();
  put_out_clipped();
  loops_.truncate(loops_mark);
  space_.release_planes(planes_mark);
}

/// The items as pieces of a list: pieces_.
template <SectorSpaceModel Space>
void SectorTree<Space>::list_pieces(std::uint32_t begin, std::uint32_t end) {
  pieces_.clear();
  clipped_.clear();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = begin; i < end; ++i) {
    const SectorItem& item = items_[i];
    // Of a floor under a vertical sun doubles may know no depth: it is not the nearest for that.
    const float nearest = item.z_high < kInfinity ? item.z_high : -kInfinity;
    pieces_.push_back({{item.first, item.count, item.part}, i, item, nearest});
  }
}

/// What has become of them, from clipped_ into the states of items.
template <SectorSpaceModel Space>
void SectorTree<Space>::put_out_clipped() {
  static_assert(ClippedPiece::kLit == kAllLit);
  // What has one class and caster all over is decided as a whole; the cells above may join it.
  for (const ClippedPiece& piece : clipped_) {
    SectorState& state = states_[piece.item];
    state = state == kUndecided || state == piece.caster ? piece.caster : kMixed;
  }
  for (const ClippedPiece& piece : clipped_) {
    if (states_[piece.item] == kMixed) emit(piece.loop, piece.caster);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_TWO_PASS_LEAF_H
