// SPDX-License-Identifier: LGPL-3.0-or-later
// Tiles of what a light sees: cells of a grid over the boxes of outlines, each with the parts whose
// boxes meet it. A tile only tells who to ask, so that its borders may be doubles.
#ifndef GNOMON_ALGORITHMS_SCAN_OUT_DIRECTION_TILES_H
#define GNOMON_ALGORITHMS_SCAN_OUT_DIRECTION_TILES_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/box.h"

namespace gnomon {

class DirectionTiles {
 public:
  /// `cells` to a side, over the boxes of the members.
  DirectionTiles(std::span<const Box> boxes, std::span<const std::uint32_t> members,
                 std::uint32_t cells);

  /// Appends the members of all tiles that the box meets, each once, ascending.
  void find(const Box& box, std::vector<std::uint32_t>& found);
  /// Entries of all tiles.
  std::uint64_t writes() const { return writes_; }

 private:
  struct Range {
    std::array<std::uint32_t, 3> low, high;  // inclusive
  };
  Range range_of(const Box& box) const;
  std::vector<std::uint32_t>& tile(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return tiles_[(std::size_t{z} * cells_ + y) * cells_ + x];
  }
  template <class Use>
  void for_each_tile(const Range& range, const Use& use);

  std::uint32_t cells_;
  Box all_;
  std::vector<std::vector<std::uint32_t>> tiles_;
  std::uint64_t writes_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCAN_OUT_DIRECTION_TILES_H
