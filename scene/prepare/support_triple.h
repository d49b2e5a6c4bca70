// SPDX-License-Identifier: LGPL-3.0-or-later
// The three vertices that stand for the support plane of a coplanar family.
//
// Rounded kernels compute the plane from them, once, so that the triple decides how well the plane
// of *every* polygon of the family is known. Of a sliver it would be known badly, and which part
// comes first would then change verdicts. So the triple is chosen from the vertices of all polygons
// of the family, and depends neither on where their loops start nor on their order.
#ifndef GNOMON_SCENE_PREPARE_SUPPORT_TRIPLE_H
#define GNOMON_SCENE_PREPARE_SUPPORT_TRIPLE_H

#include <span>

#include "gnomon/kernel/geometry.h"
#include "scene/geometry/loop_geometry.h"

namespace gnomon::scene_detail {

/// a is the vertex of the smallest index, b the farthest from a, c the farthest from the line a b;
/// ties go to the smallest index. The triangle is counter-clockwise seen from the tip of
/// `normal`, or clockwise if `flipped`.
///
/// With d the diameter of the vertices and w their width (of the narrowest strip that holds them):
/// |ab| >= d / 2, and all are within h of the line ab, with h the distance of c, so that h >= w
/// / 2. In arithmetic of unit roundoff u the direction of (b - a) x (c - a), from coordinates as
/// they are stored, is off by at most about 4u |ab| |ac| / (|ab| h) <= 8u d / w, since |ac| <= |ab|
/// <= d: no triple does better than by a constant factor. Requires: coplanar vertices with this
/// normal, not all on one line. Exactness: exact. Cost: O(n).
template <class Int>
SupportTriple support_triple(const GridPositions& grid, std::span<const VertexId> vertices,
                             const Vec3<Int>& normal, bool flipped) {
  const int axis = projection_axis(normal);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  SupportTriple triple;
  triple.a = *std::min_element(vertices.begin(), vertices.end());
  const Vec3<Int> a = point<Int>(grid, triple.a);
  /// The vertex of the largest value, none below zero.
  const auto largest = [&](const auto& value_of) {
    VertexId best = triple.a;
    Int most = 0;
    for (const VertexId vertex : vertices) {
      Int value = value_of(Vec3<Int>(point<Int>(grid, vertex) - a));
      if (value < most || (value == most && vertex >= best)) continue;
      best = vertex;
      most = std::move(value);
    }
    return best;
  };
  triple.b = largest([](const Vec3<Int>& from_a) { return dot(from_a, from_a); });
  const Vec3<Int> ab = point<Int>(grid, triple.b) - a;
  const auto turn = [&](const Vec3<Int>& ac) { return Int(ab[u] * ac[v] - ab[v] * ac[u]); };
  triple.c = largest([&](const Vec3<Int>& ac) {
    const Int area = turn(ac);
    return area < 0 ? Int(-area) : area;
  });
  if ((turn(point<Int>(grid, triple.c) - a) > 0) != (flipped != (normal[axis] > 0))) {
    std::swap(triple.b, triple.c);
  }
  return triple;
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_SUPPORT_TRIPLE_H
