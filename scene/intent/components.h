// SPDX-License-Identifier: LGPL-3.0-or-later
// Components of polygons that share edges: which are closed, and which way they look.
#ifndef GNOMON_SCENE_INTENT_COMPONENTS_H
#define GNOMON_SCENE_INTENT_COMPONENTS_H

#include <cstdint>
#include <vector>

#include "gnomon/scene/intent.h"
#include "scene/intent/local_points.h"

namespace gnomon::scene_detail {

/// One side of a polygon's border: the polygon runs along the edge from a to b.
struct HalfEdge {
  std::uint32_t edge = 0;  // those with the same number run between the same vertices
  std::uint32_t polygon = 0;
  bool flipped = false;  // from the edge's greater vertex to its smaller one
};

struct Components {
  /// Of polygons: the first polygon of their component. Dropped polygons have their own.
  std::vector<std::uint32_t> first_polygon;
  std::vector<ClosedComponent> closed;  // without lights
  std::vector<HalfEdge> half_edges;     // of all polygons that were not dropped
};

/// Edges are those of loops and holes as the scene has them, so that vertices in the middle of a
/// straight border count; borders between the parts of one polygon do not.
Components find_components(const Scene& scene, const PreparedScene& prepared,
                           const LocalPoints& points);

/// Is the point inside the closed component? A point on its surface may be told either way.
bool is_inside(const PreparedScene& prepared, const LocalPoints& points,
               const ClosedComponent& component, const Vector& point);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_INTENT_COMPONENTS_H
