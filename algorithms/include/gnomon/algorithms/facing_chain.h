// SPDX-License-Identifier: LGPL-3.0-or-later
// The facing chain: all polygons that face a light and cast, as one surface with a boundary. Its
// boundary is the contour: edges between facing and hidden polygons, and borders of open surfaces.
// Edges that two facing neighbours share are none of it, so that the shadow of a whole solid has as
// many walls as its outline has edges.
//
// Crow 1977, "contour edges"; Appel 1967; the ridge edges of Thakur, Cheng & Miura, section 2.1,
// where meshes are closed.
#ifndef GNOMON_ALGORITHMS_FACING_CHAIN_H
#define GNOMON_ALGORITHMS_FACING_CHAIN_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// One edge of the contour, with the facing side on its left as seen from the light.
struct ContourEdge {
  PlaneRef edge;  // index(): an edge of the geometry; flipped(): it runs from edge.b to edge.a
  /// How many more facing polygons run along it this way than the other way. 1 on closed meshes of
  /// one-sided polygons; 2 if these are two-sided; any number where edges are shared by many.
  std::uint32_t multiplicity = 1;
};

struct FacingChain {
  std::vector<ContourEdge> contour;  // by edges
  /// Loops of contour edges strung head to tail, as indices into `contour`: loop i is
  /// [loop_start[i], loop_start[i + 1]). Every contour edge is there as often as its multiplicity
  /// says.
  std::vector<std::uint32_t> loop_edges;
  std::vector<std::uint32_t> loop_start;
  /// Of all facing polygons that cast, each with all of its own: what would cast without a chain.
  std::uint64_t facing_edges = 0;

  std::size_t loops() const { return loop_start.empty() ? 0 : loop_start.size() - 1; }
  std::span<const std::uint32_t> loop(std::size_t i) const {
    return {loop_edges.data() + loop_start[i], loop_start[i + 1] - loop_start[i]};
  }
  /// Contour edges, with multiplicity, for each edge of a facing polygon; 0 if none faces.
  double contour_share() const {
    return facing_edges == 0
               ? 0
               : static_cast<double>(loop_edges.size()) / static_cast<double>(facing_edges);
  }
};

/// The chain of the parts that cast with the given sides: `facing` is by part, kOn where neither
/// side faces. A part whose plane holds the light does not face; it belongs to the hidden side.
///
/// At every vertex as many contour edges end as start, multiplicities counted, on any mesh, open,
/// closed or with edges shared by many: the contour is the boundary of a surface. Where several
/// meet in a vertex, a loop turns through the facing polygons around it to the first that it meets.
/// T-junctions do not cancel: the long edge and its halves are different edges.
///
/// Exactness: no arithmetic; the chain is as right as `facing` is.
/// Requires: facing.size() == scene.parts.size().
/// Cost: linear in the scene.
FacingChain facing_chain(const PreparedScene& scene, std::span<const Side> facing);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FACING_CHAIN_H
