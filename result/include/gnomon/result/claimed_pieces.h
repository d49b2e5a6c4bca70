// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene that claims of pieces of lights are about ("piece_of"): every piece is a light of its
// own there, and is judged like any other.
#ifndef GNOMON_RESULT_CLAIMED_PIECES_H
#define GNOMON_RESULT_CLAIMED_PIECES_H

#include "gnomon/result/claims.h"
#include "gnomon/scene/light_pieces.h"

namespace gnomon {

bool has_pieces(const Claims& claims);
/// Errors: those of with_light_pieces(), in the file that the claims are named after.
Expected<SceneWithPieces> scene_of_pieces(const Scene& scene, const PreparedScene& prepared,
                                          const Claims& claims);

}  // namespace gnomon

#endif  // GNOMON_RESULT_CLAIMED_PIECES_H
