// SPDX-License-Identifier: GPL-3.0-or-later
// Where a scene says that it is: what readers of energy models keep in its "extra".
#ifndef GNOMON_SUNS_PLACE_SCENE_PLACE_H
#define GNOMON_SUNS_PLACE_SCENE_PLACE_H

#include <optional>

#include "gnomon/scene/scene.h"
#include "suns/place/place.h"

namespace gnomon::suns {

struct ScenePlace {
  std::optional<Place> place;
  /// Degrees from north, clockwise, to where the scene's y axis points: not 0 where a building
  /// stands in its own axes, and the sun has to be turned.
  double north = 0;
};

/// Of "extra": {"energyplus": {"location": {...}, "north_axis", "turned"}}; nothing that is not
/// there or cannot be used.
ScenePlace place_of_scene(const Scene& scene);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_PLACE_SCENE_PLACE_H
