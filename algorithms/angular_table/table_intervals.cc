// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/table_intervals.h"

#include <algorithm>
#include <bit>

namespace gnomon {

IntervalRows::IntervalRows(const TableMesh& mesh, const TableRows& rows,
                           std::span<const TableInterval> intervals,
                           std::span<const std::uint32_t> row_of)
    : intervals_(intervals.size()), reach_(intervals.size()), first_(rows.count() + 1, 0) {
  for (const std::uint32_t row : row_of) ++first_[row + 1];
  for (std::uint32_t k = 0; k < rows.count(); ++k) first_[k + 1] += first_[k];
  std::vector<std::uint32_t> next(first_.begin(), first_.end());
  for (std::size_t i = 0; i < intervals.size(); ++i) intervals_[next[row_of[i]]++] = intervals[i];
  for (std::uint32_t k = 0; k < rows.count(); ++k) {
    const std::size_t count = first_[k + 1] - first_[k];
    if (count == 0) continue;
    sort_row(RowOrder(mesh, rows.middle(k)), std::span(intervals_).subspan(first_[k], count),
             std::span(reach_).subspan(first_[k], count));
  }
}

void IntervalRows::sort_row(const RowOrder& order, std::span<TableInterval> row,
                            std::span<std::uint32_t> reach) {
  struct Placed {
    TableInterval interval;
    RowOrder::NearS begin;
  };
  std::vector<Placed> placed;
  placed.reserve(row.size());
  for (const TableInterval& one : row) placed.push_back({one, order.near(one.begin)});
  std::ranges::stable_sort(placed, [&](const Placed& a, const Placed& b) {
    return order.compare(a.interval.begin, a.begin, b.interval.begin, b.begin) < 0;
  });
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = placed[i].interval;
  for (std::uint32_t i = 0; i < row.size(); ++i) {
    reach[i] = i;
    if (i > 0 && order.compare(row[i].end, row[reach[i - 1]].end) < 0) reach[i] = reach[i - 1];
  }
}

SlabRuns::SlabRuns(std::uint32_t slabs)
    : leaves_(std::bit_ceil(std::max(slabs, 1u))), nodes_(2 * std::size_t{leaves_}) {}

void SlabRuns::add(std::uint32_t run, std::uint32_t low, std::uint32_t high) {
  for (low += leaves_, high += leaves_; low < high; low /= 2, high /= 2) {
    if (low % 2 == 1) nodes_[low++].push_back(run);
    if (high % 2 == 1) nodes_[--high].push_back(run);
  }
}

void SlabRuns::find(std::uint32_t slab, std::vector<std::uint32_t>& runs) const {
  for (std::uint32_t node = slab + leaves_; node > 0; node /= 2) {
    runs.insert(runs.end(), nodes_[node].begin(), nodes_[node].end());
  }
}

std::uint64_t SlabRuns::bytes() const {
  std::uint64_t bytes = nodes_.size() * sizeof(nodes_.front());
  for (const auto& node : nodes_) bytes += node.size() * sizeof(std::uint32_t);
  return bytes;
}

}  // namespace gnomon
