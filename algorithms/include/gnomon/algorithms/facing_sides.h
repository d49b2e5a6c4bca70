// SPDX-License-Identifier: LGPL-3.0-or-later
// Which polygons face a light, decided exactly from the prepared scene: what the facing chain,
// hidden lines and ridge edges begin with where no kernel has told it.
#ifndef GNOMON_ALGORITHMS_FACING_SIDES_H
#define GNOMON_ALGORITHMS_FACING_SIDES_H

#include <span>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// By parts: positive where the front faces a point or directional light, zero where the part's
/// plane holds it. Exact. Cost: linear in the scene.
std::vector<Sign> signs_at_light(const PreparedScene& scene, const LightPoint& light);
/// The side of each part that faces the light, from these signs.
std::vector<Side> facing_sides(const PreparedScene& scene, std::span<const Sign> signs);
/// The side of each part that faces a point or directional light: kOn where the light is in the
/// part's plane, or behind a part of one side. Exact. Cost: linear in the scene.
std::vector<Side> facing_sides(const PreparedScene& scene, const LightPoint& light);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FACING_SIDES_H
