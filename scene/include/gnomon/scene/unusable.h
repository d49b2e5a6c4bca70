// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons that no scene can have, all of them at once: for who wants to leave them out, or to see
// every error of a file and not only the first.
#ifndef GNOMON_SCENE_UNUSABLE_H
#define GNOMON_SCENE_UNUSABLE_H

#include <cstdint>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

struct PolygonProblem {
  std::uint32_t polygon = 0;  // index into Scene::polygons
  Error error;
};

/// Every polygon that prepare() would refuse, each with the first error that it finds there, in
/// order; empty if prepare() refuses none. Lights are not looked at. Errors: kIndex. Cost: that of
/// prepare().
Expected<std::vector<PolygonProblem>> unusable_polygons(const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_SCENE_UNUSABLE_H
