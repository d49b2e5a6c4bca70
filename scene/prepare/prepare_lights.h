// SPDX-License-Identifier: LGPL-3.0-or-later
// Lights on the scene's grid, and what is wrong with those that cannot be used.
#ifndef GNOMON_SCENE_PREPARE_PREPARE_LIGHTS_H
#define GNOMON_SCENE_PREPARE_PREPARE_LIGHTS_H

#include <optional>

#include "gnomon/scene/grid.h"
#include "gnomon/scene/prepare.h"
#include "scene/geometry/loop_geometry.h"

namespace gnomon::scene_detail {

/// Fills lights, light_notes and direction_bits of `out`. The grid's points from `first` on are the
/// point lights' positions and the area lights' loops, in order.
std::optional<Error> prepare_lights(const Scene& scene, const ExactGrid& grid, std::size_t first,
                                    PreparedScene& out);

/// Drops vertices that do not change the set of points, and what `kept` has beside them.
void drop_needless(std::vector<std::size_t>& kept, std::vector<Vec3<mpz_class>>& loop);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_PREPARE_LIGHTS_H
