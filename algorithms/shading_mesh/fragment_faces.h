// SPDX-License-Identifier: LGPL-3.0-or-later
// The faces that a shading mesh begins with: the fragments of a shadow result, and one face for
// each side that no light shines on. By part, front before back.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_FRAGMENT_FACES_H
#define GNOMON_ALGORITHMS_SHADING_MESH_FRAGMENT_FACES_H

#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/points.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Whether a result has what faces are made of. Errors: kUsage.
Expected<void> check_result(const ShadowResult& result);

/// Requires: check_result(result). Corners are numbered in `points`.
FaceLoops fragment_faces(const PreparedScene& scene, const ShadowResult& result,
                         PointTable& points);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_FRAGMENT_FACES_H
