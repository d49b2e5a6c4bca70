// SPDX-License-Identifier: LGPL-3.0-or-later
// In which order polygons are inserted into a tree of complete shadow volumes. A heuristic on
// doubles, the same on every kernel: the nearer a caster, the more of what comes later is IN.
#ifndef GNOMON_ALGORITHMS_SVBSP_FULL_INSERTION_ORDER_H
#define GNOMON_ALGORITHMS_SVBSP_FULL_INSERTION_ORDER_H

#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon {

/// The parts sorted by their vertex that is nearest to the light; ties keep their order.
std::vector<std::uint32_t> nearest_first(const PreparedScene& scene, const LightPoint& light,
                                         std::span<const std::uint32_t> parts);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_FULL_INSERTION_ORDER_H
