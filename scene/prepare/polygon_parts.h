// SPDX-License-Identifier: LGPL-3.0-or-later
// Takes each polygon apart into convex planar loops, and interns their support planes and edges.
#ifndef GNOMON_SCENE_PREPARE_POLYGON_PARTS_H
#define GNOMON_SCENE_PREPARE_POLYGON_PARTS_H

#include <optional>
#include <vector>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/unusable.h"
#include "scene/prepare/cut_watch.h"

namespace gnomon::scene_detail {

/// Fills parts, loops, edges, planes, first_part and notes of `out`, whose grid, positions and
/// vertex_of_input are there already. Int must hold bits_needed(b, corners of the largest polygon).
/// Errors: as prepare().
template <class Int>
std::optional<Error> make_parts(const Scene& scene, SceneWatch& watch, PreparedScene& out);

/// The errors of all polygons that have one, in order, with the same input; `out` stays as it is.
template <class Int>
std::vector<PolygonProblem> find_problems(const Scene& scene, SceneWatch& watch,
                                          const PreparedScene& out);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_POLYGON_PARTS_H
