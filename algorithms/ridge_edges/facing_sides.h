// SPDX-License-Identifier: LGPL-3.0-or-later
// Which side of each part faces a light, by signs of integers, for what is found once for all
// kernels.
#ifndef GNOMON_ALGORITHMS_RIDGE_EDGES_FACING_SIDES_H
#define GNOMON_ALGORITHMS_RIDGE_EDGES_FACING_SIDES_H

#include <span>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// By parts: positive where the front faces the light, zero where the plane holds it.
std::vector<Sign> signs_at_light(const PreparedScene& scene, const LightPoint& light);
/// The side of each part that faces the light, from these signs; kOn where none does.
std::vector<Side> facing_sides(const PreparedScene& scene, std::span<const Sign> signs);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RIDGE_EDGES_FACING_SIDES_H
