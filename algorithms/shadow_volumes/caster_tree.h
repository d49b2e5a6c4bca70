// SPDX-License-Identifier: LGPL-3.0-or-later
// Finds the parts that can be between a receiver and a light: a bounding-volume hierarchy of parts
// is asked with the shaft of two boxes (Haines & Wallace, Shaft culling for efficient ray-traced
// radiosity, 1991): the convex hull of the two.
//
// Guarantee: a part that meets the hull of the two boxes is found; others may be found, too. Boxes
// are in fractions of the grid's extent, which doubles hold to 2^-53 whatever the grid, and every
// comparison leaves a margin far above all rounding. No decision of an algorithm is made here.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_CASTER_TREE_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_CASTER_TREE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/box.h"
#include "algorithms/partition/box_tree.h"
#include "gnomon/kernel/geometry.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// A grid position as fractions of the grid's extent, each to 2^-53.
std::array<double, 3> grid_fraction(const GridPositions& grid, VertexId vertex);

/// The convex hull of two boxes, or of a box and a direction to infinity, as half-spaces with a
/// margin.
class Shaft {
 public:
  Shaft(const Box& receiver, const Box& light);
  /// `direction`: to a directional light, in grid units of any length.
  Shaft(const Box& receiver, const std::array<double, 3>& direction);
  /// False only if the box is certainly outside.
  bool may_meet(const Box& box) const;

 private:
  struct Plane {
    int u, v;          // the two axes that the normal has components along
    double nu, nv, d;  // inside: nu x_u + nv x_v <= d
  };
  void add_plane(int u, int v, double nu, double nv, double d);
  void add_tangents(const Box& receiver, const Box& light);

  std::array<Plane, 18> planes_;
  std::size_t count_ = 0;
};

/// UmbraReach tells where umbras of an area light may be. From a point p, two corners a, b of the
/// light are seen at an angle; a caster that hides both from p has a point on each of the rays, and
/// those are |x - p| sin(angle) apart or more, x the one towards a. So a caster has no umbra there
/// if it is smaller than its distance from the receiver times the sine of the smallest such angle.
class UmbraReach {
 public:
  static constexpr double kMargin = 1e-9;

  /// Umbras reach everything.
  UmbraReach() = default;
  /// `light`: its corners, to within kMargin.
  UmbraReach(std::span<const std::array<double, 3>> light, const Box& receiver);
  /// False only if a caster in the box certainly has no umbra on the receiver.
  bool may_reach(const Box& caster) const;
  /// The same for all casters in the box whose own boxes have at most that diagonal.
  bool may_reach(const Box& box, double size) const;

 private:
  Box receiver_;
  double sine_ = 0;  // of the smallest angle, or less
};

class CasterTree {
 public:
  /// The hierarchy of those parts, by the geometry's grid. `jobs`: as BoxTree has it.
  CasterTree(const Geometry& geometry, const PreparedScene& scene,
             std::span<const std::uint32_t> parts, unsigned jobs = 1);

  const Box& box(std::uint32_t part) const { return tree_.box(part); }
  /// Appends the parts that may meet the shaft, in order of their numbers.
  void find(const Shaft& shaft, std::vector<std::uint32_t>& parts) const;
  /// Appends those of them whose umbra may reach the receiver.
  void find(const Shaft& shaft, const UmbraReach& reach, std::vector<std::uint32_t>& parts) const;

 private:
  BoxTree tree_;                 // its boxes are those of all parts
  std::vector<double> largest_;  // of each node: the longest diagonal of a part's box below it
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_CASTER_TREE_H
