// SPDX-License-Identifier: GPL-3.0-or-later
// Success by borders (docs: semantics; proven in oracle.md): a partition of one polygon side is
// right but for thin strips along its own borders, shown without an overlay. Its fragments tile the
// side when their edges are moved by so much (border_tiling.h), no shadow reaches deeper into one
// that is lit, and one in shadow lies so far in shadows.
//
// Exactness: a proof or nothing. What it tells are upper bounds of area and width, in extended
// precision with every rounding error added; it never says that anything is wrong.
#ifndef GNOMON_ORACLE_JUDGE_BORDER_PROOF_H
#define GNOMON_ORACLE_JUDGE_BORDER_PROOF_H

#include <cstdint>
#include <optional>

#include "gnomon/oracle/compare.h"

namespace gnomon::oracle {

/// The tolerance and width of a verdict.
struct BorderLimits {
  double share = 0;  // of the polygon
  double width = 0;  // scene units
};

/// Nothing if borders do not show that every share of error is at most the limit, and every region
/// of it and every vertex off its plane, but for what rounding excuses. Else the bounds; shares are
/// zero where there is no error at all. Regions, T-vertices, and what is invented or lost are not
/// counted. Point and directional lights, and fragments that tile; for others nothing is shown.
std::optional<PolygonComparison> prove_by_borders(const ExactAnswer& answer, std::uint32_t light,
                                                  const AnswerEntry& entry,
                                                  const ClaimedPolygon* candidate,
                                                  const ClaimedTerms& terms,
                                                  const BorderLimits& limits);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_BORDER_PROOF_H
