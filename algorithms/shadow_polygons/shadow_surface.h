// SPDX-License-Identifier: LGPL-3.0-or-later
// A wall or a cap of shadow volumes as the ray of a sample comes through it.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_SURFACE_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_SURFACE_H

#include <cstdint>

#include "algorithms/pixels/row_search.h"
#include "kernel/concept/image_space.h"

namespace gnomon {

struct ShadowSurface {
  PlaneRef plane;
  Sign eye_side = Sign::kZero;  // of the plane, where the eye is; not zero
  std::int32_t change = 0;      // of the count of volumes that hold the ray's point
};

/// The samples of a row whose rays come through it, before or beyond what they see.
struct CrossedSurface {
  ShadowSurface surface;
  Span span;
};

/// Does the ray come through `first` before `second`? Requires: it comes through both. False if
/// they are in one plane.
template <ImageSpaceModel Space>
bool is_before(Space& space, const ShadowSurface& first, const ShadowSurface& second,
               ImageSample sample) {
  return space.side_at_sample(second.plane, first.plane, sample) == second.eye_side;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_SURFACE_H
