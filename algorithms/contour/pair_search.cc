// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/pair_search.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

#include "algorithms/partition/in_parallel.h"

namespace gnomon {
namespace {

constexpr std::uint32_t kRowGrain = 4096;

/// Turns counts into the sums of those before each; returns the sum of all.
std::uint32_t sum_up(std::span<std::uint32_t> counts) {
  std::uint32_t sum = 0;
  for (std::uint32_t& count : counts) sum += std::exchange(count, sum);
  return sum;
}

}  // namespace

/// Sweeps all strips and counts the pairs of each slot.
bool PairSearch::find_pairs(const PairOptions& options) {
  const std::uint64_t most = std::min(options.most_pairs, PairOptions::kMostPairs);
  const std::uint32_t size = entries_.size();
  for (auto* numbers : {&slots_, &owners_, &counts_, &places_}) make_room(*numbers, size);
  for (StripSweep& sweep : sweeps_) sweep.clear();
  strip_pairs_.assign(entries_.strips(), {});
  std::atomic<std::uint64_t> found = 0;
  std::atomic<bool> too_many = false;
  in_parallel(options.jobs, entries_.strips(), 1, [&](std::uint32_t begin, std::uint32_t end) {
    StripSweep& sweep = sweeps_.local();
    for (std::uint32_t strip = begin; strip < end && !too_many; ++strip) {
      StripPairs& pairs = strip_pairs_[strip];
      pairs.sweep = &sweep;
      pairs.begin = sweep.pairs().used;
      const bool complete =
          sweep.run(lanes_, entries_, strip, most, slots_.data(), owners_.data(), counts_.data());
      pairs.end = sweep.pairs().used;
      if (!complete || (found += pairs.end - pairs.begin) > most) too_many = true;
      for (std::uint32_t i = entries_.own_begin(strip); i < entries_.end(strip); ++i) {
        places_[slots_[i]] = counts_[i];
      }
    }
  });
  return !too_many;
}

/// Writes what the entries [begin, end) of a strip contribute to the rows of their boxes.
void PairSearch::write_rows(const StripPairs& pairs, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) counts_[i] = places_[slots_[i]];
  const std::uint32_t* first = pairs.sweep->pairs().first.data();
  const std::uint32_t* second = pairs.sweep->pairs().second.data();
  for (std::uint64_t i = pairs.begin; i < pairs.end; ++i) {
    neighbours_[counts_[first[i]]++] = owners_[second[i]];
    neighbours_[counts_[second[i]]++] = owners_[first[i]];
  }
}

/// The rows of boxes, whose slots are one after another and so are what they contribute.
void PairSearch::make_rows_of_boxes(unsigned jobs) {
  const std::uint32_t boxes = entries_.boxes();
  const std::uint32_t size = sum_up({places_.data(), entries_.size()});
  make_room(neighbours_, size);
  first_.resize(boxes + 1);
  first_[boxes] = size;
  in_parallel(jobs, boxes, kRowGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t box = begin; box < end; ++box) {
      first_[box] = places_[entries_.first_slot(box)];
    }
  });
  in_parallel(jobs, entries_.strips(), 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t strip = begin; strip < end; ++strip) {
      write_rows(strip_pairs_[strip], entries_.own_begin(strip), entries_.end(strip));
    }
  });
}

void PairSearch::list_boxes_of_owners(std::span<const ChartBoxes> charts, std::uint32_t owners) {
  owner_box_first_.assign(owners + 1, 0);
  owner_boxes_.resize(entries_.boxes());
  for (const ChartBoxes& boxes : charts) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) ++owner_box_first_[boxes.owner(i) + 1];
  }
  for (std::uint32_t i = 0; i < owners; ++i) owner_box_first_[i + 1] += owner_box_first_[i];
  sizes_.assign(owner_box_first_.begin(), owner_box_first_.end() - 1);
  std::uint32_t box = 0;
  for (const ChartBoxes& boxes : charts) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      owner_boxes_[sizes_[boxes.owner(i)]++] = box++;
    }
  }
}

/// Puts the rows of owners with several boxes into neighbours_, from where first_ says, each number
/// once. A pair is found in each chart that both are in. sizes_ gets the length of every row.
void PairSearch::join_rows_of_boxes(unsigned jobs) {
  const auto owners = static_cast<std::uint32_t>(sizes_.size());
  const auto size_of = [&](std::uint32_t box) { return box_first_[box + 1] - box_first_[box]; };
  first_.assign(owners + 1, 0);
  in_parallel(jobs, owners, kRowGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t owner = begin; owner < end; ++owner) {
      for (const std::uint32_t box : boxes_of(owner)) first_[owner] += size_of(box);
    }
  });
  sum_up(first_);
  in_parallel(jobs, owners, kRowGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t owner = begin; owner < end; ++owner) {
      sizes_[owner] = first_[owner + 1] - first_[owner];
      if (boxes_of(owner).size() < 2) continue;
      const auto row = neighbours_.begin() + first_[owner];
      auto last = row;
      for (const std::uint32_t box : boxes_of(owner)) {
        last = std::copy_n(box_neighbours_.begin() + box_first_[box], size_of(box), last);
      }
      std::sort(row, last);
      sizes_[owner] = static_cast<std::uint32_t>(std::unique(row, last) - row);
    }
  });
}

/// The rows of owners from those of their boxes.
void PairSearch::make_rows_of_owners(std::span<const ChartBoxes> charts, std::uint32_t owners,
                                     unsigned jobs) {
  list_boxes_of_owners(charts, owners);
  box_first_.swap(first_);
  box_neighbours_.swap(neighbours_);
  make_room(neighbours_, box_first_.back());
  join_rows_of_boxes(jobs);
  const std::uint32_t size = sum_up(sizes_);
  make_room(joined_, size);
  in_parallel(jobs, owners, kRowGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t owner = begin; owner < end; ++owner) {
      const auto boxes = boxes_of(owner);
      const auto row = boxes.size() == 1 ? box_neighbours_.begin() + box_first_[boxes[0]]
                                         : neighbours_.begin() + first_[owner];
      const std::uint32_t next = owner + 1 == owners ? size : sizes_[owner + 1];
      std::copy_n(row, next - sizes_[owner], joined_.begin() + sizes_[owner]);
    }
  });
  neighbours_.swap(joined_);
  std::copy(sizes_.begin(), sizes_.end(), first_.begin());
  first_[owners] = size;
}

bool PairSearch::run(std::span<const ChartBoxes> charts, std::uint32_t owners,
                     const PairOptions& options) {
  entries_.make(charts, options.casts, options.jobs);
  if (!find_pairs(options)) {
    first_.assign(owners + 1, 0);
    return false;
  }
  make_rows_of_boxes(options.jobs);
  if (charts.size() == 1 && charts[0].owners.empty()) {
    assert(charts[0].size() == owners);
  } else {
    make_rows_of_owners(charts, owners, options.jobs);
  }
  return true;
}

}  // namespace gnomon
