// SPDX-License-Identifier: GPL-3.0-or-later
// Which plane of a polygon that has several a claimed fragment belongs to.
#ifndef GNOMON_ORACLE_JUDGE_CLAIMED_GROUPS_H
#define GNOMON_ORACLE_JUDGE_CLAIMED_GROUPS_H

#include <cstddef>
#include <vector>

#include "gnomon/oracle/exact_answer.h"
#include "gnomon/result/claims.h"
#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

/// By how much more than to the nearest plane a fragment's distance to another may be for that to
/// be as near, grid units. `radius`: of rounding, scene units; it moves a fragment that is not
/// exact towards one plane and away from another.
double nearly_as_near(const PreparedScene& prepared, const ClaimedFragment& fragment,
                      double radius);

/// The group whose plane a fragment is nearest to; of several nearly as near, one that it lies in.
/// `charts`: of the groups. `radius`: of rounding, scene units.
std::size_t group_for(const ExactAnswer& answer, const AnswerEntry& entry,
                      const std::vector<Chart>& charts, const ClaimedFragment& fragment,
                      double radius);

/// Whether a point is strictly inside of a convex loop, counter-clockwise.
bool contains(const std::vector<ChartPoint>& convex, const ChartPoint& point);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_CLAIMED_GROUPS_H
