// SPDX-License-Identifier: LGPL-3.0-or-later
// Which lights a run is for, and the checks that every entry point makes first.
#ifndef GNOMON_ALGORITHMS_RUN_LIGHT_SELECTION_H
#define GNOMON_ALGORITHMS_RUN_LIGHT_SELECTION_H

#include <vector>

#include "gnomon/algorithms/shadows.h"

namespace gnomon {

/// The lights asked for, or all. Errors: kUsage (no such light, a thickness outside [0, 1), a
/// floating-point environment without IEEE semantics).
Expected<std::vector<std::uint32_t>> select_lights(const PreparedScene& scene,
                                                   const ShadowOptions& options);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_LIGHT_SELECTION_H
