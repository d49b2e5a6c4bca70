// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene's geometry with its lights in it: the vertices of area lights, point lights, and the
// edges and planes of area lights, so that kernels can make planes through polygons and lights
// alike. What a light shares with a polygon (a vertex, an edge, a plane) has the same number, so
// that identity knows it.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_LIGHT_GEOMETRY_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_LIGHT_GEOMETRY_H

#include <cstdint>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/orientation.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// An area light as a loop of the geometry, counter-clockwise seen from the front, which emits; or
/// a point light as one vertex, without edges and plane. A directional light has no vertex.
struct LightFace {
  std::vector<VertexId> loop;
  std::vector<PlaneRef> edges;  // as PreparedScene::loop_edges
  PlaneId plane = 0;
  bool flipped = false;  // its front is the back of that plane
};

struct LightGeometry {
  const PreparedScene* scene = nullptr;
  Geometry geometry;             // the scene's numbers of vertices, edges and planes stay valid
  std::vector<LightFace> faces;  // one for each of scene->lights
};

/// Cost: O(n) for each light. Exact.
LightGeometry make_light_geometry(const PreparedScene& scene);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_LIGHT_GEOMETRY_H
