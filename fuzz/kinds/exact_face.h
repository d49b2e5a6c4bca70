// SPDX-License-Identifier: GPL-3.0-or-later
// A polygon or an area light with integer corners, and what is exactly true of one such face, or of
// two: the plane, the interior, edges and corners in common.
#ifndef GNOMON_FUZZ_KINDS_EXACT_FACE_H
#define GNOMON_FUZZ_KINDS_EXACT_FACE_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/base/vectors.h"

namespace gnomon::fuzz {

using Integers = std::array<mpz_class, 3>;
using Loop = std::vector<Integers>;

/// The largest extent of the points along an axis. Requires: points.
mpz_class extent_of(const Loop& points);
/// The largest magnitude of the three.
mpz_class largest(const Integers& a);
mpz_class squared_length(const Integers& a);

struct Face {
  Loop loop;
  Integers normal;      // its area vector, twice
  bool planar = true;   // exactly
  bool convex = false;  // and planar, without holes

  const Integers& corner(std::size_t i) const { return loop[i % loop.size()]; }
  /// Positive in front of the plane.
  int side(const Integers& p) const { return sgn(dot(normal, minus(p, loop[0]))); }
  /// Of a point in the plane: 1 in the interior, 0 on the border, -1 outside. Requires: convex.
  int within(const Integers& p) const {
    int least = 1;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Integers edge = minus(corner(i + 1), loop[i]);
      least = std::min(least, sgn(dot(normal, cross(edge, minus(p, loop[i])))));
    }
    return least;
  }
  bool holds_inside(const Integers& p) const { return convex && side(p) == 0 && within(p) > 0; }
  bool coplanar_with(const Face& other) const {
    return planar && other.planar &&
           std::ranges::all_of(other.loop, [&](const Integers& p) { return side(p) == 0; });
  }
};

Face face_of(Loop loop, bool holes);

template <class Test>
bool any_corner(const Face& face, const Test& test) {
  return std::ranges::any_of(face.loop, test);
}

/// `test` gets both ends of an edge.
template <class Test>
bool any_edge(const Face& face, const Test& test) {
  for (std::size_t i = 0; i < face.loop.size(); ++i) {
    if (test(face.loop[i], face.corner(i + 1))) return true;
  }
  return false;
}

/// `test` gets both ends of an edge of `a`, then both ends of an edge of `b`.
template <class Test>
bool any_edges(const Face& a, const Face& b, const Test& test) {
  return any_edge(a, [&](const Integers& p, const Integers& q) {
    return any_edge(b, [&](const Integers& r, const Integers& s) { return test(p, q, r, s); });
  });
}

// Of points and edges.

bool collinear(const Integers& a, const Integers& b, const Integers& c);
/// Is p strictly between a and b?
bool inside_edge(const Integers& p, const Integers& a, const Integers& b);
/// Are the edges ab and cd on one line, with a part in common, but not both ends?
bool edges_overlap(const Integers& a, const Integers& b, const Integers& c, const Integers& d);

// Of one face.

/// Is the longest edge over a million times longer than the face is wide? A needle has an edge that
/// is over a million times shorter than the longest, a sliver none that is over a hundred times
/// shorter.
bool is_thin(const Face& face, bool needle);
/// Is p off the face, and nearer to it than 2^-28 of its extent?
bool is_near(const Face& face, const Integers& p);
/// Is the angle between a direction and the plane of a face less than 2^-28, and not 0?
bool grazes(const Face& face, const Integers& direction);

// Of two faces.

/// Do coplanar convex faces have an area in common?
bool overlap(const Face& a, const Face& b);
bool have_the_same_corners(const Face& a, const Face& b);
bool share_edge(const Face& a, const Face& b);
bool share_vertex(const Face& a, const Face& b);
/// Do two of their edges overlap (edges_overlap)?
bool share_part_of_edge(const Face& a, const Face& b);
/// Is a vertex of `a`, which has another plane, in the interior of `b`?
bool vertex_in_face(const Face& a, const Face& b);
/// Does an edge of `a` go through the interior of `b`?
bool pierces(const Face& a, const Face& b);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_KINDS_EXACT_FACE_H
