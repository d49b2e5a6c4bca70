// SPDX-License-Identifier: LGPL-3.0-or-later
// The tiles and the volumes that each of them names (Slater 1992, sec. 5). A volume that holds a
// tile wholly closes it: what comes later in this tile is behind it. A tile that a volume only
// meets gets it in its list.
//
// Departs from the paper: when a later volume holds a closing one, so that this one is dropped, the
// later one takes its place in the tiles that it closed; else the shadow there would be lost
// (systems: S2.2; tests/algorithms/system_counts_test.cc has the smallest scene).
#ifndef GNOMON_ALGORITHMS_TILING_TILE_LISTS_H
#define GNOMON_ALGORITHMS_TILING_TILE_LISTS_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/tiling/tile_grid.h"

namespace gnomon {

class TileLists {
 public:
  TileLists(std::uint32_t faces, std::uint32_t tiles)
      : tiles_(tiles), heads_(std::size_t{faces} * tiles * tiles) {}

  /// Calls visit(volume) for each entry of the tiles, in no order; a volume may come repeatedly.
  template <class Visit>
  void for_each_entry(std::span<const MetTiles> met, const Visit& visit) const {
    for_each_tile(met, [&](std::size_t tile, bool) {
      for (std::uint32_t i = heads_[tile].first; i != kNone; i = entries_[i].next) {
        visit(entries_[i].volume);
      }
    });
  }

  /// Adds a volume to the tiles that it meets. `is_alive(volume)`; `inherit`: whether it takes the
  /// place of a dead volume that closed a tile.
  template <class IsAlive>
  void write(std::uint32_t volume, std::span<const MetTiles> met, bool inherit,
             const IsAlive& is_alive) {
    for_each_tile(met, [&](std::size_t tile, bool interior) {
      Head& head = heads_[tile];
      if (head.closed) {
        if (inherit && !is_alive(entries_[head.first].volume)) {
          entries_[head.first].volume = volume;
          ++writes_;
        }
        return;
      }
      if (interior) {
        head.first = kNone;
        head.closed = true;
        ++closed_;
      }
      entries_.push_back({volume, head.first});
      head.first = static_cast<std::uint32_t>(entries_.size() - 1);
      ++writes_;
    });
  }

  std::uint64_t writes() const { return writes_; }
  std::uint64_t closed() const { return closed_; }
  std::uint64_t bytes() const {
    return heads_.size() * sizeof(Head) + entries_.size() * sizeof(Entry);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Head {
    std::uint32_t first = kNone;
    bool closed = false;
  };
  struct Entry {
    std::uint32_t volume, next;
  };

  template <class Visit>
  void for_each_tile(std::span<const MetTiles> met, const Visit& visit) const {
    for (const MetTiles& here : met) {
      const TileBlock& block = here.block;
      for (std::uint32_t row = block.low[1]; row < block.high[1]; ++row) {
        const std::size_t begin = (std::size_t{block.face} * tiles_ + row) * tiles_;
        for (std::uint32_t column = block.low[0]; column < block.high[0]; ++column) {
          visit(begin + column, here.interior);
        }
      }
    }
  }

  std::uint32_t tiles_;
  std::vector<Head> heads_;
  std::vector<Entry> entries_;
  std::uint64_t writes_ = 0, closed_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TILING_TILE_LISTS_H
