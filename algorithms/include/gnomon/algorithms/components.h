// SPDX-License-Identifier: LGPL-3.0-or-later
// Components of a prepared scene: parts joined by shared edges, which of them are closed, and which
// closed ones are convex. Methods that speak of objects instead of polygons ask for them (Crow
// 1977, second class; Thakur, Cheng & Miura).
//
// Exactness: all is decided by signs of integers. Two-sided parts count with their front.
//
// gnomon/scene/intent.h also has closed components, of input polygons by their own borders: there
// solids that touch are one, and faces that look the wrong way do not open them, since it finds out
// what was meant. Here is what is.
#ifndef GNOMON_ALGORITHMS_COMPONENTS_H
#define GNOMON_ALGORITHMS_COMPONENTS_H

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon {

/// An edge of a part along which no part of its component runs the other way.
struct UnpairedEdge {
  EdgeId edge = 0;
  std::uint32_t part = 0;
};

struct Component {
  std::vector<std::uint32_t> parts;  // ascending
  /// As many parts run each way along every edge.
  bool is_closed = false;
  /// Closed, every vertex behind or on the plane of every part, and the signed volume positive: a
  /// convex solid whose faces look outwards.
  bool is_convex = false;
  /// If it is not closed: the first of its edges without a partner, by parts and their edges.
  UnpairedEdge unpaired;
};

/// By their first parts. Two parts that share an edge are joined. Where more than two meet in an
/// edge, each is joined to the next around it on its back side, one that has its own back there, so
/// that solids which touch fall apart; parts that are left without such a partner are not joined
/// there.
///
/// Cost: linear, and for closed components without reflex edges vertices times planes.
std::vector<Component> find_components(const PreparedScene& scene);

/// An edge of a convex shell. Seen from outside the left part runs along it, from `from` to `to`.
struct ShellEdge {
  static constexpr std::uint32_t kMissing = std::numeric_limits<std::uint32_t>::max();

  VertexId from = 0, to = 0;
  std::uint32_t left = 0, right = 0;  // places in ConvexShell::parts; right: or kMissing
};

/// The surface of a convex solid, but perhaps for some of its faces: a closed box, or a house
/// without a floor.
struct ConvexShell {
  std::vector<std::uint32_t> parts;    // ascending; their fronts look outwards
  std::vector<VertexId> vertices;      // ascending
  std::vector<ShellEdge> edges;        // each once
  std::vector<SupportTriple> missing;  // of each face that is not there, counter-clockwise as seen
                                       // from outside
};

/// The components of two to `most_parts` parts that are convex shells: two parts run along every
/// edge, one each way, or one does and the edge is on the border of a missing face; and every
/// vertex is behind or on the plane of every part and of every missing face, not all of them on
/// one.
///
/// `jobs` other than 1: on the threads of the arena that the caller is in; they are the same. Cost:
/// linear, and for each shell vertices times planes.
std::vector<ConvexShell> find_convex_shells(const PreparedScene& scene, std::uint32_t most_parts,
                                            unsigned jobs = 1);

/// "edge (x,y,z)-(x,y,z) of polygon P has no partner", with the nearest doubles.
std::string unpaired_edge_text(const Scene& scene, const PreparedScene& prepared,
                               const UnpairedEdge& unpaired);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_COMPONENTS_H
