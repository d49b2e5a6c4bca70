// SPDX-License-Identifier: GPL-3.0-or-later
// Small lattice scenes: polygons whose corners are among the 27 points with coordinates 0, 1 and 2,
// so that nearly every relation between two polygons, and between a polygon and a light, is exactly
// degenerate, several at once. Where systems of shadow volumes go wrong, they do so here.
#ifndef GNOMON_FUZZ_GENERATE_SMALL_LATTICE_H
#define GNOMON_FUZZ_GENERATE_SMALL_LATTICE_H

#include <cstdint>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

/// Two to about a dozen polygons: single ones, duplicates, reversed copies, fans, closed boxes,
/// T-junctions; one- and two-sided, some of them mixed; some only receive. One or two lights: suns
/// with components from -2 to 2, and lamps on lattice points, in a polygon's plane, in the middle
/// of a cell or around the lattice.
Scene small_lattice(std::uint64_t seed);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_SMALL_LATTICE_H
