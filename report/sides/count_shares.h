// SPDX-License-Identifier: GPL-3.0-or-later
// Areas by number of casters (gnomon/algorithms/caster_counts.h), from parts to the polygons of the
// file.
//
// Exactness: as of classes: exact rationals where all parts lie in one plane and exact fractions
// were asked for, certified enclosures otherwise.
#ifndef GNOMON_REPORT_SIDES_COUNT_SHARES_H
#define GNOMON_REPORT_SIDES_COUNT_SHARES_H

#include <gmpxx.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "gnomon/algorithms/caster_counts.h"
#include "gnomon/scene/prepare.h"
#include "report/sides/part_weights.h"

namespace gnomon::report {

/// The share of a polygon's side behind `count` casters. What faces away from the light has none,
/// so that the shares of a bent polygon may add up to less than 1.
struct CountShare {
  std::uint32_t count = 0;
  Interval share;
  std::optional<mpq_class> exact;
};

/// Ascending by count; none if no part of the polygon faces the light. `exact`: the counts have
/// exact shares.
std::vector<CountShare> count_shares(const PreparedScene& scene, const CasterCounts& counts,
                                     std::uint32_t polygon, bool exact, const PartWeights& weights);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_COUNT_SHARES_H
