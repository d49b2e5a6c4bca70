// SPDX-License-Identifier: GPL-3.0-or-later
// Area by casters, the oracle's way. By their number: the shadows of all casters on one receiver
// (point_regions.h) in one exact overlay, whose winding numbers are the counts. By each of them:
// the areas of these shadows. No tree, no cell, no piece cut by another.
//
// Exactness: exact. Cost: of counts the square of the casters that reach the receiver.
#ifndef GNOMON_ORACLE_CASTER_COUNTS_H
#define GNOMON_ORACLE_CASTER_COUNTS_H

#include <gmpxx.h>

#include <cstdint>
#include <map>

#include "gnomon/oracle/point_regions.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

/// By number of casters between it and the light, the share of the part's area; shares of 0 are
/// left out, the others add up to 1. Empty if the part has no side that faces the light, or if the
/// overlay contradicts itself (a bug). `regions`: of the same scene.
std::map<std::uint32_t, mpq_class> caster_counts(const PreparedScene& scene,
                                                 const PointRegions& regions, std::uint32_t part);

/// By caster (part), the share of the part's area that is in its shadow, whatever else shadows it;
/// only those that shadow some. Empty as above.
std::map<std::uint32_t, mpq_class> caster_shares(const PreparedScene& scene,
                                                 const PointRegions& regions, std::uint32_t part);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_CASTER_COUNTS_H
