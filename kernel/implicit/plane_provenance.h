// SPDX-License-Identifier: LGPL-3.0-or-later
// What a plane was made from, and what follows from it without arithmetic.
//
// The identities of kernel `plane`. Its sources cite them by these numbers, and docs/exactness.md
// says why they are sound. A corner is on a plane
//  (1) if it is the plane of one of the corner's two edges, whatever the orientation;
//  (2) if it is the support plane of the corner's loop;
//  (3) if the corner is an input vertex that the plane was made from: one of three of a support
//      plane or of a plane of a volume, one of the two ends of the edge of a shadow plane;
//  (4) if the plane was made from two input vertices on a line that the corner is on: an input edge
//      of the corner, or the line in which two of the corner's planes meet that were made from
//      them, too; and if all three vertices are those of one of the corner's planes, which it is
//      then;
//  (5) if one of the corner's edges is the cut of the corner's support plane by it.
#ifndef GNOMON_KERNEL_IMPLICIT_PLANE_PROVENANCE_H
#define GNOMON_KERNEL_IMPLICIT_PLANE_PROVENANCE_H

#include <array>
#include <bit>
#include <cstdint>

#include "gnomon/kernel/geometry.h"
#include "kernel/signs/corner.h"

namespace gnomon {

/// Identity (1).
template <class Vertex>
bool is_edge_of(PlaneRef plane, const Corner<Vertex>& corner) {
  return plane.same_plane(corner.before) || plane.same_plane(corner.after);
}
/// Identity (3) of a support plane.
inline bool is_made_from(const SupportTriple& plane, VertexId v) {
  return v == plane.a || v == plane.b || v == plane.c;
}
/// Identity (3) of a shadow plane, by its edge.
inline bool is_made_from(EdgeEnds edge, VertexId v) { return v == edge.a || v == edge.b; }

/// Provenance of a plane through a light that is no edge's: two support planes that it goes through
/// the cut of, or integers by number.
struct LightPlaneSource {
  static constexpr std::uint32_t kExplicit = 0xffffffffu;
  std::uint32_t a = 0, b = kExplicit;

  bool is_explicit() const { return b == kExplicit; }
  /// Identity (5): the planes that it cuts.
  bool is_cut_of(PlaneId first, PlaneId second) const {
    return !is_explicit() && ((a == first && b == second) || (a == second && b == first));
  }
};

/// Provenance of a support plane or a plane of a volume: three input vertices, or integers by
/// number.
struct VolumePlaneSource {
  static constexpr std::uint32_t kExplicit = kMadeVertex;
  std::array<std::uint32_t, 3> vertices{};

  static VolumePlaneSource of_integers(std::size_t number) {
    return {{static_cast<std::uint32_t>(number), kExplicit, kExplicit}};
  }
  bool is_explicit() const { return vertices[1] == kExplicit; }
  /// Requires: is_explicit().
  std::uint32_t number() const { return vertices[0]; }
  /// Identity (3). Requires: not is_explicit().
  bool has(VertexId v) const { return vertices[0] == v || vertices[1] == v || vertices[2] == v; }

  /// Which of the three vertices others were made from, too, as a set of bits.
  unsigned shared_with(const VolumePlaneSource& other) const {
    return other.is_explicit() ? 0 : mask([&](VertexId v) { return other.has(v); });
  }
  unsigned shared_with(EdgeEnds edge) const {
    return mask([&](VertexId v) { return is_made_from(edge, v); });
  }

 private:
  template <class Has>
  unsigned mask(const Has& has) const {
    return unsigned{has(vertices[0])} | unsigned{has(vertices[1])} << 1 |
           unsigned{has(vertices[2])} << 2;
  }
};

/// Identity (4), from the sets of vertices that the plane shares with each of the corner's planes.
/// `before_is_edge`, `after_is_edge`: whether the set is of an input edge's ends.
inline bool is_on_shared_line(unsigned before, bool before_is_edge, unsigned after,
                              bool after_is_edge, unsigned support) {
  constexpr unsigned kAll = 7;
  if (before == kAll || after == kAll || support == kAll) return true;
  if (before_is_edge && std::popcount(before) == 2) return true;
  if (after_is_edge && std::popcount(after) == 2) return true;
  return std::popcount(before & after) == 2 || std::popcount(before & support) == 2 ||
         std::popcount(after & support) == 2;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_PLANE_PROVENANCE_H
