// SPDX-License-Identifier: LGPL-3.0-or-later
// Regions of lights (docs: formats, "region") on the scene's grid: their planes become planes of
// the geometry, so that kernels decide about them as they do about support planes. What a region
// shares with the polygons, a vertex or a plane, has the same number.
#ifndef GNOMON_SCENE_PREPARE_PREPARE_REGIONS_H
#define GNOMON_SCENE_PREPARE_PREPARE_REGIONS_H

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "gnomon/scene/grid.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::scene_detail {

using GridPoint = std::array<mpz_class, 3>;

/// The points of a grid from `first` on.
std::vector<GridPoint> grid_points(const ExactGrid& grid, std::size_t first);

/// Fills PreparedLight::region of all lights, and adds planes and light vertices to the geometry.
/// `points`: three a plane, in order of lights and planes. Requires: parts are made. Errors:
/// kGeometry: three points on one line. Cost: O(vertices + planes) for each plane of a region.
std::optional<Error> prepare_regions(const Scene& scene, const std::vector<GridPoint>& points,
                                     PreparedScene& out);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_PREPARE_REGIONS_H
