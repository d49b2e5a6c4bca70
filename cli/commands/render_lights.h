// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of `gnomon render` about more than where one light falls: several lights together, and the
// walls of a light's shadow volumes.
#ifndef GNOMON_CLI_COMMANDS_RENDER_LIGHTS_H
#define GNOMON_CLI_COMMANDS_RENDER_LIGHTS_H

#include <cstdint>
#include <string>
#include <vector>

#include "cli/common/algorithm_choice.h"
#include "cli/common/scene_options.h"
#include "gnomon/kernel/error.h"
#include "gnomon/result/claims.h"
#include "report/pictures/picture.h"

namespace gnomon::cli {

/// What a result file tells of the lights together or, if none is named, what is true. Errors:
/// kUsage if the file tells nothing of them, and those of reading or computing it.
Expected<Claims> lights_together(const LoadedScene& loaded, const std::string& result,
                                 const AlgorithmChoice& algorithm);

/// The shadow polygons of a point or directional light (Crow 1977, third class): of each contour
/// edge what lies behind it, a good deal longer than the scene. In scene units, rounded.
std::vector<std::vector<report::Point>> shadow_polygons(const PreparedScene& prepared,
                                                        std::uint32_t light);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_RENDER_LIGHTS_H
