// SPDX-License-Identifier: GPL-3.0-or-later
// Whether loops tile a polygon but for thin strips along their edges: the edges of all loops and of
// the polygon, taken with their directions, must cancel when vertices that are all but one are made
// one and edges are led through vertices that all but lie on them. Proven in docs (oracle, "Success
// by borders").
//
// Exactness: combinatorial; how far every edge was moved is measured.
#ifndef GNOMON_ORACLE_JUDGE_BORDER_TILING_H
#define GNOMON_ORACLE_JUDGE_BORDER_TILING_H

#include <span>

#include "oracle/geometry/planar_loop.h"
#include "oracle/judge/error_strips.h"

namespace gnomon::oracle {

/// A loop, counter-clockwise, and how often it counts. The true loop lies within `slack` of it, but
/// for the error of coordinates.
struct TilingLoop {
  const PlanarLoop* loop = nullptr;
  int sign = 1;
  long double slack = 0;
};

/// False if they do not cancel. Else every point that lies in none of the strips that are added is
/// wound around by all loops together 0 times. The first loop that has a vertex keeps its place.
/// `snap`: by how much vertices are moved at most, in x and y. `error`: of coordinates.
bool cancel(std::span<const TilingLoop> loops, long double snap, long double error,
            ErrorStrips& strips);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_BORDER_TILING_H
