// SPDX-License-Identifier: GPL-3.0-or-later
// Exact points instead of exact regions: for scenes above the pair limit. Points inside a
// candidate's fragments and points at random places of the polygon, each decided by visibility.h or
// area_visibility.h.
#ifndef GNOMON_ORACLE_JUDGE_POINT_CHECK_H
#define GNOMON_ORACLE_JUDGE_POINT_CHECK_H

#include <cstdint>
#include <optional>

#include "gnomon/oracle/compare.h"
#include "gnomon/oracle/exact_answer.h"
#include "gnomon/oracle/visibility.h"

namespace gnomon::oracle {

struct PointCheck {
  std::uint64_t checked = 0, wrong = 0, on_boundary = 0;
  std::optional<Witness> worst;  // the first that is wrong
};

/// `visibility`: of a point or directional light; null for an area light, whose own is used.
PointCheck check_points(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry,
                        const ClaimedPolygon* candidate, const ClaimedTerms& terms,
                        const VisibilityTest* visibility, std::uint32_t count, std::uint64_t seed);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_POINT_CHECK_H
