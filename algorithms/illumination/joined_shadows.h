// SPDX-License-Identifier: LGPL-3.0-or-later
// What casters hide together of the light from all of a triangle of a receiver. Casters that have
// edges on one line hide what passes by them there, whether they share an edge or meet in a
// T-junction: whatever passes one of the two at the line meets the other. Pairs of casters, closed
// fans round a vertex, and sheets of connected casters.
//
// Exactness: what is taken away is hidden from every point of the triangle. Proof:
// docs/illumination.md, "Deep umbra".
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_JOINED_SHADOWS_H
#define GNOMON_ALGORITHMS_ILLUMINATION_JOINED_SHADOWS_H

#include <span>

#include "algorithms/illumination/cell_shadow.h"
#include "algorithms/illumination/edge_lines.h"
#include "algorithms/illumination/visible_pieces.h"

namespace gnomon {

/// Takes away what single casters and joined ones hide.
void subtract_joined(LightPieces& pieces, const EdgeLines& lines, std::span<CellShadow> shadows);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_JOINED_SHADOWS_H
