// SPDX-License-Identifier: LGPL-3.0-or-later
// Lights from the command line: --point=x,y,z, --sun=x,y,z, --area=x,y,z:x,y,z:...
#ifndef GNOMON_SCENE_LIGHT_ARGUMENTS_H
#define GNOMON_SCENE_LIGHT_ARGUMENTS_H

#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// The texts behind --point, --sun and --area, in the order given.
struct LightArguments {
  std::vector<std::string> points, suns, areas;
};

/// Blanks around numbers are allowed. Errors: kUsage (not three coordinates, fewer than three
/// points), kNumber, kLimit, kGeometry (a sun at 0,0,0).
Expected<Light> parse_light_argument(LightType type, std::string_view text, NumberMeaning meaning,
                                     std::string id);

/// The lights get the ids point0, point1, ..., sun0, ..., area0, ...
Expected<std::vector<Light>> lights_from_arguments(const LightArguments& arguments,
                                                   NumberMeaning meaning);

/// Appends lights to a scene's own. Errors: kId if an id is taken.
Expected<void> add_lights(Scene& scene, std::vector<Light> lights);

}  // namespace gnomon

#endif  // GNOMON_SCENE_LIGHT_ARGUMENTS_H
