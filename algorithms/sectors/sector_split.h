// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the k-d tree of light space splits a cell: by a histogram of the polygons' boxes in the
// chart of their sector. A heuristic on certified boxes: the planes that come out are exact, and
// the answer does not depend on them.
#ifndef GNOMON_ALGORITHMS_SECTORS_SECTOR_SPLIT_H
#define GNOMON_ALGORITHMS_SECTORS_SECTOR_SPLIT_H

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/partition/chart_box.h"
#include "algorithms/partition/chart_split.h"

namespace gnomon {

/// SectorItem is a polygon clipped to a cell. Its box and its depths are certified: the
/// polygon's directions are within [low, high] and its z within [z_low, z_high] (infinite where
/// nothing is known, or the kernel rounds: as its coordinates say).
struct SectorItem : ChartBox {
  float z_low = -kInfinity, z_high = kInfinity;
  std::uint32_t first = 0;  // its loop
  std::uint32_t count : 30 = 0;
  std::uint32_t fresh : 1 = 1;     // new in this cell: its loop was clipped
  std::uint32_t receives : 1 = 1;  // else it only casts, and its own classes are not asked for
  std::uint32_t part = 0;
  std::uint32_t parent = 0;  // the item of the parent cell that it is a piece of
};

class SplitChooser {
 public:
  /// Chooses the best split; none if no split pays (kSplitGrowth).
  std::optional<ChartSplit> choose(std::span<const SectorItem> items);

 private:
  static constexpr int kBins = 32;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_SECTOR_SPLIT_H
