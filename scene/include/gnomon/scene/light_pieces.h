// SPDX-License-Identifier: LGPL-3.0-or-later
// A prepared scene whose area lights are cut into pieces, each a light of its own: what is needed
// to ask of every piece what is asked of a light.
//
// Exactness: pieces have rational corners. The grid is made so much finer that they lie on it,
// which changes no sign: positions, parts and all other lights stay what they are.
#ifndef GNOMON_SCENE_LIGHT_PIECES_H
#define GNOMON_SCENE_LIGHT_PIECES_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

struct LightPiece {
  std::string id;                              // of its own
  std::string of;                              // id of the area light that it was cut from
  std::vector<std::array<mpq_class, 3>> loop;  // counter-clockwise seen from its front, scene units
};

struct SceneWithPieces {
  /// Lights that are cut are replaced by their pieces, the others stay. A piece's loop here is
  /// rounded to doubles; in `prepared` it is exact.
  Scene scene;
  PreparedScene prepared;
  std::vector<std::uint32_t> source;  // index in the whole scene of each light, or of what it is of
  /// Lights that their pieces do not tile, in sentences.
  std::vector<std::string> gaps;
};

/// Requires: `prepared` was made from `scene`. Errors: kGeometry for a piece of no area light, and
/// for one that is not convex, not exactly in the light's plane, turned over, or not inside of it.
Expected<SceneWithPieces> with_light_pieces(const Scene& scene, const PreparedScene& prepared,
                                            const std::vector<LightPiece>& pieces);

}  // namespace gnomon

#endif  // GNOMON_SCENE_LIGHT_PIECES_H
