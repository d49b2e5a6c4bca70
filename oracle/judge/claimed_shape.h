// SPDX-License-Identifier: GPL-3.0-or-later
// A claimed loop with its holes as convex pieces: a loop that is not convex, touches itself or
// crosses itself is what it winds around, less what its holes wind around, as in the comparison
// (geometry/overlay.h).
#ifndef GNOMON_ORACLE_JUDGE_CLAIMED_SHAPE_H
#define GNOMON_ORACLE_JUDGE_CLAIMED_SHAPE_H

#include <cstdint>
#include <vector>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

/// On the plane of a part, on the grid's axes; vertices off the plane are projected.
std::vector<std::vector<HomogeneousPoint>> convex_pieces(const PreparedScene& scene,
                                                         std::uint32_t part,
                                                         const ClaimedShape& shape);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_CLAIMED_SHAPE_H
