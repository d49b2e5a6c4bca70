// SPDX-License-Identifier: LGPL-3.0-or-later
// What is in a row of an angular table: intervals between two edges, sorted by where they begin. To
// find those that hold an s one goes back from the last that begins before it, and stops where none
// of all before reaches it.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_INTERVALS_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_INTERVALS_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/angular_table/row_order.h"

namespace gnomon {

struct TableInterval {
  std::uint32_t begin = 0, end = 0;  // edges of the table
  std::uint32_t owner = 0;           // an object, or a part
};

class IntervalRows {
 public:
  /// Sorts by rows. `intervals` and `rows` are of the same size.
  IntervalRows(const TableMesh& mesh, const TableRows& rows,
               std::span<const TableInterval> intervals, std::span<const std::uint32_t> row_of);

  std::span<const TableInterval> row(std::uint32_t k) const {
    return std::span(intervals_).subspan(first_[k], first_[k + 1] - first_[k]);
  }
  /// Of each place in the row: which of the intervals up to it ends last.
  std::span<const std::uint32_t> reach(std::uint32_t k) const {
    return std::span(reach_).subspan(first_[k], first_[k + 1] - first_[k]);
  }
  std::size_t size() const { return intervals_.size(); }
  std::uint64_t bytes() const {
    return intervals_.size() * (sizeof(TableInterval) + sizeof(std::uint32_t)) +
           first_.size() * sizeof(std::uint32_t);
  }

 private:
  void sort_row(const RowOrder& order, std::span<TableInterval> row,
                std::span<std::uint32_t> reach);

  std::vector<TableInterval> intervals_;
  std::vector<std::uint32_t> reach_;
  std::vector<std::uint32_t> first_;  // by rows, and the end
};

/// What runs through whole slabs: of each slab, those that run through it. A tree of halves of all
/// slabs, each run in at most two halves of every size.
class SlabRuns {
 public:
  explicit SlabRuns(std::uint32_t slabs);

  /// A run through [low, high).
  void add(std::uint32_t run, std::uint32_t low, std::uint32_t high);
  /// Appends the runs of a slab.
  void find(std::uint32_t slab, std::vector<std::uint32_t>& runs) const;
  std::uint64_t bytes() const;

 private:
  std::uint32_t leaves_ = 1;
  std::vector<std::vector<std::uint32_t>> nodes_;  // 1 is all; n has 2 n and 2 n + 1
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_INTERVALS_H
