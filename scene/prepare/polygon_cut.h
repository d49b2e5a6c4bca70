// SPDX-License-Identifier: LGPL-3.0-or-later
// Cuts a projected polygon with holes into triangles, and merges these into convex parts. prepare.h
// says what that is for.
//
// Which loops are legal: no ring crosses itself or another, none runs round an area twice; holes
// lie inside the loop, and their interiors do not overlap. Rings may touch themselves and each
// other, in points and along edges: a loop that reaches a hole along an edge and comes back on it
// (a keyhole) is legal. Everything else is a CutProblem that names the place. In a polygon that is
// not planar, rings may touch only in vertices that they share.
//
// The rule goes by vertex indices of the scene alone (`key`), so that it depends neither on where a
// loop starts nor on its direction:
//  1. Edges that two rings share cancel, and rings that touch in vertices become one ring
//     (region_loops.h). A polygon that its holes cut apart falls into components.
//  2. Holes inside a component are joined to its ring by bridges (bridges.h). Holes are taken in
//     order of their smallest key. A bridge goes from a vertex of the hole to a vertex of the ring,
//     both taken in order of key: the first pair that see each other.
//  3. The ear at the smallest key is clipped, again and again (ear_clipper.h). An ear is a strictly
//     convex corner whose *closed* triangle holds no other vertex of the ring, except vertices at
//     its own three corners. So a vertex that only touches an edge or the diagonal of an ear
//     forbids the ear, and no triangle ever has a vertex of the polygon inside one of its edges.
//     (2 and 3: up to kMostForEars corners of all rings. A larger polygon is swept in the order of
//     x and then y in its projection, cut into monotone faces and these into triangles, by no rule
//     but its coordinates: sweep_cut.h.)
//  4. Parts of a planar polygon are merged across diagonals, bridges among them, while the union
//     is convex (convex_merge.h). Diagonals are taken in order of their sorted pairs of keys. Then
//     collinear vertices are dropped.
#ifndef GNOMON_SCENE_PREPARE_POLYGON_CUT_H
#define GNOMON_SCENE_PREPARE_POLYGON_CUT_H

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "scene/prepare/cut_watch.h"

namespace gnomon::scene_detail {

/// Bridges and ears take the cube of the number of corners at worst. Every polygon of the papers is
/// below; coastlines and perforated screens are above.
inline constexpr std::size_t kMostForEars = 256;

/// Vertices of one polygon in the projection, and its rings over them: the loop first, then the
/// holes. The loop is counter-clockwise; holes are of either orientation.
template <class Int>
struct CutInput {
  std::vector<Int> x, y;
  std::vector<std::uint32_t> key;
  std::vector<std::vector<std::uint32_t>> rings;
  bool planar = true;  // in space: then parts are merged, and holes may touch inside of edges
  CutWatch* watch = nullptr;  // none: nobody waits
  /// Up to so many corners of all rings bridges are built and ears clipped; larger polygons are cut
  /// by a sweep.
  std::size_t most_for_ears = kMostForEars;

  bool stopped() const { return watch != nullptr && watch->stopped(); }
  void tell(double done) const {
    if (watch != nullptr) watch->tell(done);
  }
};

struct CutProblem {
  std::size_t ring = 0;  // 0 is the loop, j + 1 is hole j
  std::string what;      // "crosses itself between vertices 3-4 and 7-8"
  bool stopped = false;  // by the watch
};

/// Convex counter-clockwise loops of indices into the input's vertices, each starting at its
/// smallest key, sorted by their keys. Cost: O(n log n) for n corners, more by what touches.
template <class Int>
tl::expected<std::vector<std::vector<std::uint32_t>>, CutProblem> cut_into_convex_parts(
    CutInput<Int> input);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_POLYGON_CUT_H
