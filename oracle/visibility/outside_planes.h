// SPDX-License-Identifier: GPL-3.0-or-later
// The planes of a light's region (docs: formats, "region") as the oracle has them: from their three
// points on the grid, by itself.
#ifndef GNOMON_ORACLE_VISIBILITY_OUTSIDE_PLANES_H
#define GNOMON_ORACLE_VISIBILITY_OUTSIDE_PLANES_H

#include <vector>

#include "gnomon/scene/prepare.h"
#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

/// What is strictly in front of one of them is outside of the region. Exact.
std::vector<ExactPlane> outside_planes(const Geometry& geometry, const PreparedLight& light);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_OUTSIDE_PLANES_H
