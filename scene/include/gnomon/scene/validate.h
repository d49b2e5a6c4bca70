// SPDX-License-Identifier: LGPL-3.0-or-later
// The rules that a scene obeys as a data structure, wherever it came from: ids, indices, loops of
// at least three vertices, well-formed lights. What the numbers mean as geometry is prepare.h's.
#ifndef GNOMON_SCENE_VALIDATE_H
#define GNOMON_SCENE_VALIDATE_H

#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// An id is not empty and holds no '#' and no control character.
bool is_valid_id(std::string_view id);

/// The first offence, with the scene's file and the JSON pointer of the place, or nothing. Errors:
/// kId, kIndex, kFormat (too few vertices), kGeometry (to_light = 0). Cost: O(size of the scene).
Expected<void> validate_scene(const Scene& scene);

/// Checks the lights alone: of a file that holds nothing else, or lights that were merged into a
/// scene.
Expected<void> validate_lights(const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_SCENE_VALIDATE_H
