// SPDX-License-Identifier: LGPL-3.0-or-later
// In which order polygons are taken where no answer depends on it: inserted into a tree of complete
// shadow volumes, or drawn. A heuristic on doubles, the same on every kernel: the nearer a polygon,
// the more of what comes later is hidden by it.
#ifndef GNOMON_ALGORITHMS_PARTITION_INSERTION_ORDER_H
#define GNOMON_ALGORITHMS_PARTITION_INSERTION_ORDER_H

#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/algorithms/method_options.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// The parts sorted by their vertex that is nearest to the light, or eye; ties keep their order.
/// Those of a file stay as they are.
std::vector<std::uint32_t> in_order(InsertionOrder order, const PreparedScene& scene,
                                    const LightPoint& light, std::span<const std::uint32_t> parts);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_INSERTION_ORDER_H
