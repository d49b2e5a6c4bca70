// SPDX-License-Identifier: GPL-3.0-or-later
// A light that is a point, in the finite or at infinity, and how polygons stand to each other as
// seen from it.
#ifndef GNOMON_FUZZ_KINDS_APEX_H
#define GNOMON_FUZZ_KINDS_APEX_H

#include "fuzz/kinds/exact_face.h"

namespace gnomon::fuzz {

struct Apex {
  Integers p;      // its position, or the direction to it
  int weight = 1;  // 0 at infinity

  Integers from(const Integers& v) const { return weight == 1 ? minus(p, v) : p; }
  int side(const Face& face) const { return sgn(dot(face.normal, from(face.loop[0]))); }
  /// A normal of the plane through the apex and two points.
  Integers plane(const Integers& a, const Integers& b) const { return cross(from(a), minus(b, a)); }
};

/// Is c exactly in front of or behind the inside of the edge from a to b?
bool on_shadow_edge(const Apex& apex, const Integers& a, const Integers& b, const Integers& c);
/// Is c exactly in front of or behind a?
bool on_shadow_vertex(const Apex& apex, const Integers& a, const Integers& c);
/// Where edges of a and b cross as seen from the apex: 1 if a is nearer to the apex there, -1 if b
/// is, 0 if none cross with one strictly nearer.
int nearer(const Apex& apex, const Face& a, const Face& b);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_KINDS_APEX_H
