// SPDX-License-Identifier: LGPL-3.0-or-later
// Which polygons face a light, decided exactly from the prepared scene: what the facing chain,
// hidden lines and ridge edges begin with where no kernel has told it.
#ifndef GNOMON_ALGORITHMS_FACING_SIDES_H
#define GNOMON_ALGORITHMS_FACING_SIDES_H

#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// The side of each part that faces a point or directional light: kOn where the light is in the
/// part's plane, or behind a part of one side. Exact. Cost: linear in the scene.
std::vector<Side> facing_sides(const PreparedScene& scene, const LightPoint& light);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FACING_SIDES_H
