// SPDX-License-Identifier: LGPL-3.0-or-later
// A near and a far plane, as graphics hardware clips a picture: planes across the view at distances
// from the eye along "forward". They become support planes of a copy of the scene, whose grid is
// made finer until their corners are on it; so every kernel decides about them as about any plane.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_CLIP_PLANES_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_CLIP_PLANES_H

#include "gnomon/kernel/image_frame.h"
#include "gnomon/kernel/orientation.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Not valid(): there is none.
struct ClipPlanes {
  PlaneRef near, far;
};

struct ClippedScene {
  PreparedScene scene;
  ImageFrame frame;
  ClipPlanes planes;
};

/// The same scene and picture, with planes at these distances, scene units, to within a thousandth
/// of them. 0: none. Requires: not negative.
ClippedScene with_clip_planes(const PreparedScene& scene, const ImageFrame& frame, double near,
                              double far);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_CLIP_PLANES_H
