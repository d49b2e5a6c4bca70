// SPDX-License-Identifier: LGPL-3.0-or-later
// Closed convex solids that cast as wholes (Chin & Feiner 1989, sec. 6, silhouette edges). The
// shadow of such a solid of a light outside of it is one convex volume: what is behind all faces
// that the light is in front of, and inside of the planes through the light and their contour
// edges. It is the union of the shadows of these faces, and of all faces.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_SOLID_CASTERS_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_SOLID_CASTERS_H

#include <cstdint>
#include <vector>

namespace gnomon {

struct SolidCasters {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::vector<std::vector<std::uint32_t>> solids;  // parts of each, all of which cast
  std::vector<std::uint32_t> of_part;              // its solid, or kNone; empty: there is none
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_SOLID_CASTERS_H
