// SPDX-License-Identifier: LGPL-3.0-or-later
// From the crossings of an object with one row to its spans of shadow; and the mistakes that one
// may make there.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_ROW_SPANS_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_ROW_SPANS_H

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/angular_table/ridge_pairs.h"
#include "algorithms/angular_table/row_order.h"
#include "algorithms/partition/rules.h"

namespace gnomon {

/// An edge that crosses a row, with its sense.
struct RowCrossing {
  std::uint32_t edge = 0;
  std::int32_t sense = 0;
};

/// Sorts along the row: where two cross in one place the one that enters comes first, then that of
/// the smaller edge.
void sort_along(const RowOrder& order, std::vector<RowCrossing>& crossings);
/// Calls use(begin, end), edges, for each longest span on which the sum of the senses is more than
/// zero. Requires: sorted.
template <class Use>
void for_each_span(std::span<const RowCrossing> crossings, const Use& use) {
  std::int32_t sum = 0;
  std::uint32_t begin = 0;
  for (const RowCrossing& crossing : crossings) {
    const bool was_dark = sum > 0;
    sum += crossing.sense;
    if (!was_dark && sum > 0) begin = crossing.edge;
    if (was_dark && sum <= 0) use(begin, crossing.edge);
  }
}

/// The crossings of one loop with the rows' other rules: in order along each row, in pairs of
/// neighbours; or in the pairs of the loop, each from its left end to its right one.
std::vector<RidgeCrossing> misread_crossings(const TableMesh& mesh, const TableRows& rows,
                                             const EdgeLoop& loop, const Rules& rules);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_ROW_SPANS_H
