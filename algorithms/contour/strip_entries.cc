// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/strip_entries.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "algorithms/partition/in_parallel.h"

namespace gnomon {

template <class Body>
void StripEntries::for_each_block(unsigned jobs, const Body& body) {
  in_parallel(jobs, static_cast<std::uint32_t>(blocks_.size()), 1,
              [&](std::uint32_t begin, std::uint32_t end) {
                for (std::uint32_t i = begin; i < end; ++i) body(blocks_[i]);
              });
}

/// Blocks change nothing in the entries. There are so few that their counts of bins take no more
/// memory than the entries.
void StripEntries::make_blocks(std::span<const ChartBoxes> charts, unsigned jobs) {
  constexpr std::uint32_t kGrain = 2048, kMostBlocks = 64;
  blocks_.clear();
  boxes_ = 0;
  for (std::uint32_t chart = 0; chart < charts.size(); ++chart) {
    const std::uint32_t n = charts[chart].size();
    const std::uint32_t most = 4 * n / plans_[chart].strips();
    const std::uint32_t blocks =
        jobs == 1 ? 1 : std::clamp(std::min(n / kGrain, most), 1u, kMostBlocks);
    for (std::uint64_t i = 0; i < blocks; ++i) {
      blocks_.push_back({.chart = chart,
                         .begin = static_cast<std::uint32_t>(i * n / blocks),
                         .end = static_cast<std::uint32_t>((i + 1) * n / blocks),
                         .first_box = boxes_,
                         .first_count = 0,
                         .tall = {}});
    }
    boxes_ += n;
  }
}

void StripEntries::find_spans(const ChartBoxes& boxes, Block& block) {
  const StripPlan& plan = plans_[block.chart];
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    assert(boxes.low_u[i] <= boxes.high_u[i] && boxes.low_v[i] <= boxes.high_v[i]);
    const StripSpan span = {plan.strip_of(boxes.low_v[i]), plan.strip_of(boxes.high_v[i])};
    spans_[block.first_box + i] = span;
    block.tall.add(span);
  }
}

void StripEntries::make_layers(std::span<const ChartBoxes> charts) {
  layers_.resize(charts.size());
  chart_bin_.assign(1, 0);
  auto block = blocks_.begin();
  std::uint32_t count = 0;
  for (std::uint32_t chart = 0; chart < charts.size(); ++chart) {
    TallStrips tall;
    const auto first = block;
    for (; block != blocks_.end() && block->chart == chart; ++block) tall.add(block->tall);
    layers_[chart].make(charts[chart].size(), plans_[chart].strips(), tall, chart_bin_.back());
    chart_bin_.push_back(layers_[chart].end_bin());
    for (auto i = first; i != block; ++i) {
      i->first_count = count;
      count += chart_bin_[chart + 1] - chart_bin_[chart];
    }
  }
  counts_.assign(count, 0);
}

void StripEntries::count(Block& block) {
  const StripLayers& layers = layers_[block.chart];
  std::uint32_t* counts = counts_.data() + block.first_count;
  const std::uint32_t first_bin = chart_bin_[block.chart];
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    layers.for_each_entry(spans_[block.first_box + i], [&](std::uint32_t bin, bool, bool) {
      ++counts[bin - first_bin];
      ++block.entries;
    });
  }
}

/// Where each bin begins, and in it each block; `entries` of a block becomes its first slot.
void StripEntries::place_bins() {
  bin_begin_.assign(1, 0);
  std::uint32_t next = 0, slot = 0;
  auto block = blocks_.begin();
  for (std::uint32_t chart = 0; chart + 1 < chart_bin_.size(); ++chart) {
    const auto first = block;
    for (; block != blocks_.end() && block->chart == chart; ++block) {
      slot += std::exchange(block->entries, slot);
    }
    for (std::uint32_t bin = 0; bin < chart_bin_[chart + 1] - chart_bin_[chart]; ++bin) {
      for (auto i = first; i != block; ++i) {
        next += std::exchange(counts_[i->first_count + bin], next);
      }
      bin_begin_.push_back(next);
    }
  }
}

void StripEntries::put(const ChartBoxes& boxes, std::span<const std::uint8_t> casts, Block& block) {
  const StripLayers& layers = layers_[block.chart];
  std::uint32_t* places = counts_.data() + block.first_count;
  const std::uint32_t first_bin = chart_bin_[block.chart];
  std::uint32_t slot = block.entries;
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    const std::uint32_t owner = boxes.owner(i);
    const std::uint32_t trait = casts.empty() || casts[owner] != 0 ? kCasts : 0;
    first_slot_[block.first_box + i] = slot;
    layers.for_each_entry(spans_[block.first_box + i], [&](std::uint32_t bin, bool starts,
                                                           bool own) {
      const std::uint32_t traits = trait | (starts ? kStarts : 0) | (own ? kOwnLayer : 0);
      entries_[places[bin - first_bin]++] = {
          boxes.low_u[i], boxes.low_v[i], boxes.high_u[i], boxes.high_v[i], slot++, owner, traits};
    });
  }
}

void StripEntries::make(std::span<const ChartBoxes> charts, std::span<const std::uint8_t> casts,
                        unsigned jobs) {
  if (plans_.size() < charts.size()) plans_.resize(charts.size());
  for (std::size_t i = 0; i < charts.size(); ++i) plans_[i].make(charts[i]);
  make_blocks(charts, jobs);
  make_room(spans_, boxes_);
  for_each_block(jobs, [&](Block& block) { find_spans(charts[block.chart], block); });
  make_layers(charts);
  for_each_block(jobs, [&](Block& block) { count(block); });
  place_bins();
  make_room(entries_, size());
  make_room(first_slot_, boxes_);
  for_each_block(jobs, [&](Block& block) { put(charts[block.chart], casts, block); });
}

}  // namespace gnomon
