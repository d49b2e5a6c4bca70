// SPDX-License-Identifier: LGPL-3.0-or-later
// What is on each edge of one polygon: what hides it and where, and what lies behind it.
#ifndef GNOMON_ALGORITHMS_CONTOUR_EDGE_LISTS_H
#define GNOMON_ALGORITHMS_CONTOUR_EDGE_LISTS_H

#include <cstdint>
#include <vector>

#include "algorithms/contour/stretches.h"

namespace gnomon {

/// A polygon behind an edge, or beside it on its outer side, with its depth at the edge's ends.
template <class Numbers>
struct Behind {
  Place<Numbers> low, high;
  typename Numbers::T depth_from{}, depth_to{};
  double depth_error = 0;  // certified
  std::uint32_t polygon = 0;
  bool covers_both = false;  // else on the outer side alone
};

/// What is on one edge. Kept from polygon to polygon, for its memory.
template <class Numbers>
struct EdgeLists {
  std::vector<Stretch<Numbers>> hidden;  // by a caster above the edge's polygon on its inner side
  std::vector<Stretch<Numbers>> taken;   // where another acts in its place, or nothing is behind it
  std::vector<Behind<Numbers>> behind;   // below the edge
  std::vector<Behind<Numbers>> level;    // whose plane holds the edge, and which it may act on
  std::vector<Behind<Numbers>> beside;   // casters at the edge's own depth on its outer side alone
  // What is hidden from the edge's first end on, and to its last: until where, and from where.
  Place<Numbers> first, last;

  void clear() {
    hidden.clear();
    taken.clear();
    behind.clear();
    level.clear();
    beside.clear();
    first = Place<Numbers>::from();
    last = Place<Numbers>::to();
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_EDGE_LISTS_H
