// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/result/claimed_pieces.h"

#include <algorithm>
#include <utility>

namespace gnomon {

bool has_pieces(const Claims& claims) {
  return std::ranges::any_of(claims.lights,
                             [](const ClaimedLight& light) { return !light.piece_of.empty(); });
}

Expected<SceneWithPieces> scene_of_pieces(const Scene& scene, const PreparedScene& prepared,
                                          const Claims& claims) {
  std::vector<LightPiece> pieces;
  for (const ClaimedLight& light : claims.lights) {
    if (light.piece_of.empty()) continue;
    pieces.push_back({light.id, light.piece_of, light.piece_loop});
  }
  auto result = with_light_pieces(scene, prepared, pieces);
  if (!result) {
    Error error = result.error();
    error.where.file = claims.name;
    return tl::unexpected(std::move(error));
  }
  return result;
}

}  // namespace gnomon
