// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls of shadow volumes: from each edge of a contour the half-infinite polygon that the light
// throws from it, { L + k (v - L) : v on the edge, k >= 1 }, or for a sun { v - k d : k >= 0 }.
// With the facing polygons as caps they enclose all shadow. Crow 1977, "the third class".
//
// A wall is never constructed. It has an edge, and lies in the shadow plane of that edge.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_WALLS_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_WALLS_H

#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/algorithms/method_options.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct ShadowWall {
  PlaneRef edge;  // by EdgeId, with its direction: shadow on its left as seen from the light
  std::uint32_t multiplicity = 1;  // so many volumes begin, or end, where it is pierced
};

/// Of all parts that cast with the given sides (kOn: neither): those of the contour of their chain,
/// or one of every edge of every part, by parts.
std::vector<ShadowWall> shadow_walls(const PreparedScene& scene, std::span<const Side> facing,
                                     VolumesOf volumes);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_WALLS_H
