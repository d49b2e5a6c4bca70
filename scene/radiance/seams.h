// SPDX-License-Identifier: LGPL-3.0-or-later
// Loops with seams: where a format has no holes, the loop runs from the outline to a hole, around
// it and back along the same edge.
#ifndef GNOMON_SCENE_RADIANCE_SEAMS_H
#define GNOMON_SCENE_RADIANCE_SEAMS_H

#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon {

struct LoopWithHoles {
  std::vector<VertexId> loop;
  std::vector<std::vector<VertexId>> holes;
};

/// The outline and the holes of a loop of a scene's vertices. Edges that are run along in both
/// directions are seams and are gone, and so are parts without area. A loop without seams, or of
/// several parts of which some are no holes of the greatest one, stays as it is: preparation takes
/// such loops too. Exactness: exact.
LoopWithHoles without_seams(const Scene& scene, std::vector<VertexId> loop);

}  // namespace gnomon

#endif  // GNOMON_SCENE_RADIANCE_SEAMS_H
