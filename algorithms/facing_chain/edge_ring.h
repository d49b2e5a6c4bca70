// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts around one edge, in the exact order of their angles, and which of them bound one solid.
#ifndef GNOMON_ALGORITHMS_FACING_CHAIN_EDGE_RING_H
#define GNOMON_ALGORITHMS_FACING_CHAIN_EDGE_RING_H

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon {

/// One part along an edge.
struct EdgePart {
  std::uint32_t part = 0;
  VertexId off_edge = 0;  // a vertex of the part that is not on the edge's line
  bool flipped = false;   // the part runs from edge.b to edge.a
};

/// Pairs of parts of which each is the other's next around the edge on its back side, places in
/// `around`. Seen along the edge from a to b, angles grow counter-clockwise; a flipped part has its
/// back on the side of larger angles and opens a wedge of solid, the others close one. Pairs are
/// those of brackets that open and close in a circle, hence solids may also lie in one another.
/// Where parts lie on one another, those that close come first, so that solids which touch along a
/// face fall apart.
///
/// Exactness: the order of angles is decided by determinants of degree 3, and by one of degree 4
/// where a part is in the plane of the first.
std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_around(const GridPositions& grid,
                                                                  EdgeEnds edge,
                                                                  std::span<const EdgePart> around);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FACING_CHAIN_EDGE_RING_H
