// SPDX-License-Identifier: LGPL-3.0-or-later
// Thakur, Cheng & Miura, section 2.4: stretches of ridge edges strung into loops of one depth.
#ifndef GNOMON_ALGORITHMS_RIDGE_EDGES_SEPARATE_LOOPS_H
#define GNOMON_ALGORITHMS_RIDGE_EDGES_SEPARATE_LOOPS_H

#include <span>
#include <vector>

#include "algorithms/ridge_edges/ridge_arcs.h"

namespace gnomon {

/// A loop as indices of stretches, each of which starts where the one before ends.
using StretchLoop = std::vector<std::uint32_t>;

/// Every stretch is in one loop. At each ray an incoming stretch is followed by the outgoing one
/// that bounds the same depth.
std::vector<StretchLoop> separate_loops(std::span<const Stretch> stretches, const RidgeArcs& arcs);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RIDGE_EDGES_SEPARATE_LOOPS_H
