// SPDX-License-Identifier: LGPL-3.0-or-later
// Vertices and edges of polygons that are all but the same.
#ifndef GNOMON_SCENE_INTENT_NEAR_VERTICES_H
#define GNOMON_SCENE_INTENT_NEAR_VERTICES_H

#include <vector>

#include "gnomon/scene/intent.h"
#include "scene/intent/local_points.h"

namespace gnomon::scene_detail {

/// Pairs of different vertices that are nearer than `near`, sorted. Of a cluster of many only pairs
/// with its first are listed.
std::vector<NearlySharedVertices> find_near_vertices(const PreparedScene& scene,
                                                     const LocalPoints& points, double near);

/// Pairs of different edges whose ends are the same or among the pairs of vertices, sorted.
std::vector<NearlySharedEdges> find_near_edges(const PreparedScene& scene,
                                               const std::vector<NearlySharedVertices>& vertices);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_INTENT_NEAR_VERTICES_H
