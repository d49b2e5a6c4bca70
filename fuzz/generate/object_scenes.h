// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes for methods that see objects instead of polygons: solids that touch, and surfaces whose
// outline has a hole or winds around itself.
#ifndef GNOMON_FUZZ_GENERATE_OBJECT_SCENES_H
#define GNOMON_FUZZ_GENERATE_OBJECT_SCENES_H

#include <cstdint>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

/// Two to four closed boxes of one-sided polygons on a small lattice, one of them often a slab
/// under the others: they touch along faces, edges and corners, and none is inside of another. A
/// sun from above, a lamp outside of all of them, or both.
Scene closed_boxes(std::uint64_t seed);

/// Over a floor, one or two of: a frame of four polygons around a hole, in a plane that may be
/// tilted; and a ramp of triangles that turns around itself up to twice. A sun from above, a lamp,
/// or both.
Scene frames(std::uint64_t seed);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_OBJECT_SCENES_H
