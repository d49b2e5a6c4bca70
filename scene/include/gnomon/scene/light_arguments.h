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

/// Three coordinates, the value of an option of that name. Blanks around numbers are allowed.
/// Errors: kUsage (not three coordinates), kNumber, kLimit.
Expected<Position> parse_position(std::string_view text, NumberMeaning meaning,
                                  const std::string& option);

/// Blanks around numbers are allowed. Errors: kUsage (not three coordinates, fewer than three
/// points), kNumber, kLimit, kGeometry (a sun at 0,0,0).
Expected<Light> parse_light_argument(LightType type, std::string_view text, NumberMeaning meaning,
                                     std::string id);

/// The lights get the ids point0, point1, ..., sun0, ..., area0, ...
Expected<std::vector<Light>> lights_from_arguments(const LightArguments& arguments,
                                                   NumberMeaning meaning);

/// Where lights shine, from the command line: --cone=x,y,z:x,y,z:..., --flap=axis:low:high.
struct RegionArguments {
  std::vector<std::string> cones, flaps;

  bool none() const { return cones.empty() && flaps.empty(); }
};

/// Bounds the lights of a scene. A cone, of point lights, is the pyramid from one through a convex
/// polygon; a flap, of directional ones, too, is what is between two planes across an axis, one of
/// which may be left out ("z:0:"). Errors: kUsage (neither, no such light), kNumber, kLimit,
/// kGeometry (a polygon that is not convex as a light sees it, or edge-on).
Expected<void> add_regions(Scene& scene, const RegionArguments& arguments);

/// Appends lights to a scene's own. Errors: kId if an id is taken.
Expected<void> add_lights(Scene& scene, std::vector<Light> lights);

}  // namespace gnomon

#endif  // GNOMON_SCENE_LIGHT_ARGUMENTS_H
