// SPDX-License-Identifier: LGPL-3.0-or-later
// What a map of the light's surroundings by one perspective division does to the walls of edges
// that are beside or behind it: "the conventional perspective transformation is accurate only for a
// limited field of view" (Crow 1977). For those who look at mistakes; in doubles, as it is one.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_ONE_PERSPECTIVE_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_ONE_PERSPECTIVE_H

#include <cstdint>

#include "gnomon/scene/prepare.h"

namespace gnomon {

/// The light looks at the middle of the scene. 1 if both ends of the edge are before it or both
/// behind, -1 if the division by depth turns the edge, 0 if an end is beside it. A sun sees all in
/// one map.
std::int32_t turn_in_one_perspective(const PreparedScene& scene, const LightPoint& light,
                                     VertexId a, VertexId b);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_ONE_PERSPECTIVE_H
