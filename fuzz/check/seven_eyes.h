// SPDX-License-Identifier: GPL-3.0-or-later
// Seven eyes from which pictures of a scene are sampled: most of them in exactly degenerate places.
#ifndef GNOMON_FUZZ_CHECK_SEVEN_EYES_H
#define GNOMON_FUZZ_CHECK_SEVEN_EYES_H

#include <string>
#include <vector>

#include "gnomon/scene/camera.h"

namespace gnomon::fuzz {

struct NamedEye {
  std::string name;
  ExactCamera camera;
};

/// Inside a shadow, inside a box (the middle of the scene's), on a wall of a shadow volume, in the
/// plane of a cap, on the line of an edge, at the lamp, and a generic one; `pick` chooses the
/// parts. Those that the scene has no place for are left out. Each looks at the middle of the
/// scene, and, unless it is the generic one, a second time along an axis, so that on scenes of
/// small integers many samples are exactly on edges and planes.
std::vector<NamedEye> seven_eyes(const PreparedScene& scene, std::uint32_t size,
                                 std::uint32_t pick = 0);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_SEVEN_EYES_H
