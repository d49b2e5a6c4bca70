// SPDX-License-Identifier: LGPL-3.0-or-later
// Which of two polygons is nearer to the light, asked of their support planes: where the corners of
// one lie, and where its own plane is cut by the other's.
#ifndef GNOMON_ALGORITHMS_PARTITION_DEPTH_H
#define GNOMON_ALGORITHMS_PARTITION_DEPTH_H

#include <cstdint>

#include "algorithms/partition/import_export.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// Whether a corner of a loop is nearer to the light than a plane, and whether one is behind it.
struct DepthSides {
  bool nearer = false, behind = false;
};

/// Of a loop against the support plane of a part that faces the light.
template <SectorSpaceModel Space>
DepthSides depth_sides(Space& space, const FacingParts& facing, PlaneId plane,
                       const LoopView<typename Space::Vertex>& loop) {
  const Side nearer = facing.plane_signs[plane] == Sign::kPositive ? Side::kFront : Side::kBack;
  DepthSides sides;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const Side side = space.side_of_support(plane, loop.corner(i));
    sides.nearer |= side == nearer;
    sides.behind |= side == opposite(nearer);
  }
  return sides;
}

/// A plane that cuts loops of support plane `own` where `other` does; in front is what is nearer to
/// the light than `other`. Requires: the two meet in a line, as they do if a loop of one has
/// corners on both sides of the other.
template <SectorSpaceModel Space>
PlaneRef depth_cut(Space& space, const FacingParts& facing, PlaneId own, PlaneId other) {
  const PlaneRef front = space.cut_of_supports(own, other);
  return facing.plane_signs[other] == Sign::kPositive ? front : -front;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_DEPTH_H
