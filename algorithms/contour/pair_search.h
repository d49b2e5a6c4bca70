// SPDX-License-Identifier: LGPL-3.0-or-later
// All pairs of polygons whose boxes overlap as seen from the light, as rows of neighbours. Charts
// are cut into strips (strip_plan.h); in each, boxes are sorted by their low u and each is tested
// with those that start before it ends, eight at a time.
//
// Guarantee: complete, each pair once, and the same rows for every number of threads and every
// level of vector instructions. Cost: O(n log n + pairs) for any boxes that a sample of them
// represents. Memory: about 100 bytes a box that reaches few strips, at most 400 for tall ones, and
// 16 to 20 a pair (twice that where owners have several boxes); kept from run to run.
#ifndef GNOMON_ALGORITHMS_CONTOUR_PAIR_SEARCH_H
#define GNOMON_ALGORITHMS_CONTOUR_PAIR_SEARCH_H

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/contour/chart_boxes.h"
#include "algorithms/contour/lanes/lanes.h"
#include "algorithms/contour/strip_entries.h"
#include "algorithms/contour/strip_sweep.h"

namespace gnomon {

struct PairOptions {
  std::span<const std::uint8_t> casts = {};  // of each owner, 0 or 1; empty: all cast
  unsigned jobs = 1;                         // 1: the calling thread; else those of its arena
  std::uint64_t most_pairs = kMostPairs;     // so that memory has a limit
  /// The most pairs that rows can number.
  static constexpr std::uint64_t kMostPairs = 0x7fffffff;
};

class PairSearch {
 public:
  explicit PairSearch(const Lanes& lanes) : lanes_(lanes) {}

  /// Finds the neighbours of each of `owners` owners: those others with an overlapping box in a
  /// common chart, of which one of the two casts. Boxes that only touch overlap. Returns false, and
  /// leaves all rows empty, if there are more than options.most_pairs pairs, each counted once in
  /// each chart. Requires: at most 2^27 boxes.
  bool run(std::span<const ChartBoxes> charts, std::uint32_t owners, const PairOptions& options);

  /// Where the row of each owner begins in neighbours(); one more than there are owners.
  std::span<const std::uint32_t> first() const { return first_; }
  /// Every pair is in both rows. A row has no number twice; it rises if its owner has several
  /// boxes, else its order is one that depends on the boxes alone.
  std::span<const std::uint32_t> neighbours() const {
    return {neighbours_.data(), first_.empty() ? 0 : first_.back()};
  }
  std::span<const std::uint32_t> neighbours(std::uint32_t owner) const {
    return neighbours().subspan(first_[owner], first_[owner + 1] - first_[owner]);
  }

 private:
  /// Where the pairs of a strip are.
  struct StripPairs {
    const StripSweep* sweep = nullptr;
    std::uint64_t begin = 0, end = 0;
  };
  bool find_pairs(const PairOptions& options);
  void make_rows_of_boxes(unsigned jobs);
  void write_rows(const StripPairs& pairs, std::uint32_t begin, std::uint32_t end);
  void list_boxes_of_owners(std::span<const ChartBoxes> charts, std::uint32_t owners);
  void join_rows_of_boxes(unsigned jobs);
  void make_rows_of_owners(std::span<const ChartBoxes> charts, std::uint32_t owners, unsigned jobs);
  std::span<const std::uint32_t> boxes_of(std::uint32_t owner) const {
    return {owner_boxes_.data() + owner_box_first_[owner],
            owner_boxes_.data() + owner_box_first_[owner + 1]};
  }

  const Lanes& lanes_;
  StripEntries entries_;
  tbb::enumerable_thread_specific<StripSweep> sweeps_;
  std::vector<StripPairs> strip_pairs_;
  std::vector<std::uint32_t> slots_, owners_;  // of each sorted entry
  std::vector<std::uint32_t> counts_;          // of each sorted entry: pairs, then the next place
  std::vector<std::uint32_t> places_;          // of each slot: pairs, then the first place
  std::vector<std::uint32_t> first_, neighbours_;
  // Where owners have several boxes:
  std::vector<std::uint32_t> box_first_, box_neighbours_;  // rows of boxes
  std::vector<std::uint32_t> owner_box_first_, owner_boxes_;
  std::vector<std::uint32_t> sizes_, joined_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_PAIR_SEARCH_H
