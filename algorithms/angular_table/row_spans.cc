// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/row_spans.h"

#include <algorithm>

namespace gnomon {

void sort_along(const RowOrder& order, std::vector<RowCrossing>& crossings) {
  struct Placed {
    RowCrossing crossing;
    RowOrder::NearS near;
  };
  std::vector<Placed> placed;
  placed.reserve(crossings.size());
  for (const RowCrossing& one : crossings) placed.push_back({one, order.near(one.edge)});
  std::ranges::sort(placed, [&](const Placed& a, const Placed& b) {
    const int side = order.compare(a.crossing.edge, a.near, b.crossing.edge, b.near);
    if (side != 0) return side < 0;
    if (a.crossing.sense != b.crossing.sense) return a.crossing.sense > b.crossing.sense;
    return a.crossing.edge < b.crossing.edge;
  });
  for (std::size_t i = 0; i < placed.size(); ++i) crossings[i] = placed[i].crossing;
}

std::vector<RidgeCrossing> misread_crossings(const TableMesh& mesh, const TableRows& rows,
                                             const EdgeLoop& loop, const Rules& rules) {
  std::vector<std::vector<RidgePair>> pairs(rows.count());
  for (const RidgePair& pair : pairs_by_peaks(mesh, rows, loop)) {
    for (std::uint32_t row = pair.low; row < pair.high; ++row) pairs[row].push_back(pair);
  }
  std::vector<RidgeCrossing> result;
  for (std::uint32_t row = 0; row < rows.count(); ++row) {
    if (pairs[row].empty()) continue;
    const RowOrder order(mesh, rows.middle(row));
    std::vector<RowCrossing> crossings;
    for (const RidgePair& pair : pairs[row]) {
      const bool is_hole = order.compare(pair.enter, pair.leave) > 0;
      const bool turned = is_hole && !rules.holes_have_a_direction;
      crossings.push_back({turned ? pair.leave : pair.enter, 1});
      crossings.push_back({turned ? pair.enter : pair.leave, -1});
    }
    if (!rules.crossings_pair_by_arcs) {
      sort_along(order, crossings);
      for (std::size_t i = 0; i < crossings.size(); ++i) crossings[i].sense = i % 2 == 0 ? 1 : -1;
    }
    for (const RowCrossing& one : crossings) result.push_back({one.edge, one.sense, row, row + 1});
  }
  return result;
}

}  // namespace gnomon
