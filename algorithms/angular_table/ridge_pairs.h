// SPDX-License-Identifier: LGPL-3.0-or-later
// Thakur, Cheng & Miura, section 3.2: the crossings of a ridge loop with the rows of a table, in
// pairs. Seen along a row, a loop that goes down is where one comes onto its facing side, and one
// that goes up is where one leaves it; each maximal arc of the loop above a row is a pair.
//
// Exactness: no arithmetic; only the ranks of vertices among the rows are asked.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_RIDGE_PAIRS_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_RIDGE_PAIRS_H

#include <cstdint>
#include <vector>

#include "algorithms/angular_table/table_mesh.h"
#include "algorithms/angular_table/table_rows.h"

namespace gnomon {

/// The two ends of an arc above the rows [low, high).
struct RidgePair {
  std::uint32_t enter = 0, leave = 0;  // edges of the table
  std::uint32_t low = 0, high = 0;
};

/// The paper's way, without sorting: from each local peak both branches are walked downwards; where
/// two groups have reached one local minimum they become one, and what remains of them is a pair
/// below. Of neighbours of equal height the edge between is skipped.
std::vector<RidgePair> pairs_by_peaks(const TableMesh& mesh, const TableRows& rows,
                                      const EdgeLoop& loop);

/// Where an edge of a loop crosses the rows [low, high): `sense` +1 where one comes onto the facing
/// side along the row, -1 where one leaves it.
struct RidgeCrossing {
  std::uint32_t edge = 0;
  std::int32_t sense = 0;
  std::uint32_t low = 0, high = 0;
};

/// All crossings of a loop, in its order.
std::vector<RidgeCrossing> crossings_of(const TableMesh& mesh, const TableRows& rows,
                                        const EdgeLoop& loop);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_RIDGE_PAIRS_H
