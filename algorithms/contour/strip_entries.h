// SPDX-License-Identifier: LGPL-3.0-or-later
// The boxes of all charts, put into the strips that they reach: the first half of the search of
// pairs. Entries lie bin by bin (strip_layers.h), and in a bin by the numbers of their boxes.
#ifndef GNOMON_ALGORITHMS_CONTOUR_STRIP_ENTRIES_H
#define GNOMON_ALGORITHMS_CONTOUR_STRIP_ENTRIES_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/contour/chart_boxes.h"
#include "algorithms/contour/strip_layers.h"
#include "algorithms/contour/strip_plan.h"

namespace gnomon {

/// What a pair must have between its two boxes (kAllTraits): one that starts in the strip, one that
/// casts, one that is in its own layer.
inline constexpr std::uint32_t kStarts = 1, kCasts = 2, kOwnLayer = 4;

/// A box in a strip.
struct StripEntry {
  float low_u, low_v, high_u, high_v;
  std::uint32_t slot;  // entries numbered by boxes, all of a box one after another
  std::uint32_t owner;
  std::uint32_t traits;
  std::uint32_t unused = 0;  // two entries a cache line
};

/// Makes at least n places; what is there stays or is lost.
template <class T>
void make_room(std::vector<T>& vector, std::size_t n) {
  if (vector.size() < n) vector.resize(n + n / 8);
}

class StripEntries {
 public:
  /// `casts`: of each owner; empty: all cast. Requires: at most 2^27 boxes.
  void make(std::span<const ChartBoxes> charts, std::span<const std::uint8_t> casts, unsigned jobs);

  std::uint32_t boxes() const { return boxes_; }
  std::uint32_t size() const { return bin_begin_.back(); }
  std::uint32_t strips() const { return static_cast<std::uint32_t>(bin_begin_.size() / 2); }
  /// Where the entries of a strip begin: first those of its own layer, then those of finer layers.
  std::uint32_t own_begin(std::uint32_t strip) const { return bin_begin_[2 * strip]; }
  std::uint32_t finer_begin(std::uint32_t strip) const { return bin_begin_[2 * strip + 1]; }
  std::uint32_t end(std::uint32_t strip) const { return bin_begin_[2 * strip + 2]; }
  const StripEntry& operator[](std::uint32_t entry) const { return entries_[entry]; }
  /// The first slot of a box; boxes are numbered chart by chart. The slot after the last one of the
  /// last box is size().
  std::uint32_t first_slot(std::uint32_t box) const { return first_slot_[box]; }

 private:
  /// Boxes of one chart that one thread works on, one after another.
  struct Block {
    std::uint32_t chart, begin, end;  // numbered in the chart
    std::uint32_t first_box;          // the number of the chart's first box
    std::uint32_t first_count;        // of its bins in counts_
    std::uint32_t entries = 0;
    TallStrips tall;
  };
  void make_blocks(std::span<const ChartBoxes> charts, unsigned jobs);
  void make_layers(std::span<const ChartBoxes> charts);
  void find_spans(const ChartBoxes& boxes, Block& block);
  void count(Block& block);
  void place_bins();
  void put(const ChartBoxes& boxes, std::span<const std::uint8_t> casts, Block& block);
  template <class Body>
  void for_each_block(unsigned jobs, const Body& body);

  std::uint32_t boxes_ = 0;
  std::vector<StripPlan> plans_;          // of each chart
  std::vector<StripLayers> layers_;       // of each chart
  std::vector<std::uint32_t> chart_bin_;  // the first bin of each chart, and the end
  std::vector<Block> blocks_;
  std::vector<StripSpan> spans_;  // of each box
  std::vector<std::uint32_t>
      counts_;  // of each block and bin: entries, then where the next one goes
  std::vector<std::uint32_t> bin_begin_{0};
  std::vector<StripEntry> entries_;
  std::vector<std::uint32_t> first_slot_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_STRIP_ENTRIES_H
