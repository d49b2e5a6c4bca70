// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons that overlap and are all but in one plane.
#ifndef GNOMON_SCENE_INTENT_NEAR_PLANES_H
#define GNOMON_SCENE_INTENT_NEAR_PLANES_H

#include <vector>

#include "gnomon/scene/intent.h"
#include "scene/geometry/box_tree.h"
#include "scene/intent/local_points.h"

namespace gnomon::scene_detail {

/// The boxes of parts, widened by `near`, in local points.
std::vector<Box> boxes_of_parts(const PreparedScene& scene, const LocalPoints& points, double near);

/// Sorted by polygons. Parts of one polygon are no pair, and parts in one plane are none.
std::vector<NearlyCoplanarPair> find_nearly_coplanar(const PreparedScene& scene,
                                                     const LocalPoints& points,
                                                     const std::vector<Box>& boxes,
                                                     const BoxTree& tree, double near);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_INTENT_NEAR_PLANES_H
