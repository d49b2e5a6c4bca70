// SPDX-License-Identifier: LGPL-3.0-or-later
// Openings that cannot be cut out of their wall. Files of the field have doors whose sill is on the
// wall's edge, and not exactly: such a loop crosses the edge, or touches it beside the wall's
// plane, and no polygon has it as a hole.
#ifndef GNOMON_SCENE_BUILDING_UNCUT_OPENINGS_H
#define GNOMON_SCENE_BUILDING_UNCUT_OPENINGS_H

#include <cstddef>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// Which holes of a polygon cannot be used: taken one after the other, each beside those before it
/// that can. None if the loop cannot be used without any, for that is not their fault. Errors:
/// those of unusable_polygons().
Expected<std::vector<std::size_t>> unusable_holes(const Scene& scene, const Polygon& polygon);

}  // namespace gnomon

#endif  // GNOMON_SCENE_BUILDING_UNCUT_OPENINGS_H
