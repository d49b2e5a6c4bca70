// SPDX-License-Identifier: LGPL-3.0-or-later
// The contour of any set of parts, for those who choose themselves which parts are of the chain.
#ifndef GNOMON_ALGORITHMS_FACING_CHAIN_CONTOUR_H
#define GNOMON_ALGORITHMS_FACING_CHAIN_CONTOUR_H

#include <span>
#include <vector>

#include "gnomon/algorithms/facing_chain.h"

namespace gnomon {

/// The contour of the parts with the given sides, whether they cast or not: `sides` is by part, kOn
/// for those that are not of the chain. By edges. Exactness, requires: as facing_chain().
std::vector<ContourEdge> contour_of(const PreparedScene& scene, std::span<const Side> sides);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FACING_CHAIN_CONTOUR_H
