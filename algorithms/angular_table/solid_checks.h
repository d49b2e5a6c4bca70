// SPDX-License-Identifier: LGPL-3.0-or-later
// What depth=hidden takes for granted, as the paper does: closed solids of one-sided polygons that
// do not penetrate each other, and a light and receivers outside of them. Then what is beyond a
// hidden face has passed through the solid before it.
//
// Exactness: decided by signs of integers. One way into a solid is not found: through edges of it
// alone, without touching the inside of any of its faces.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_SOLID_CHECKS_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_SOLID_CHECKS_H

#include <vector>

#include "algorithms/angular_table/table_objects.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Objects are closed, all of their polygons cast and have one side, no polygon of one is back to
/// back on another of it or turned inside out, and no polygon goes through another's face into a
/// solid or lies inside of one. `names` may be null. Errors: kGeometry; names the polygons and the
/// edge.
Expected<void> check_solids(const PreparedScene& scene, const Scene* names,
                            const std::vector<TableObject>& objects);

/// The light is not inside of a solid. Errors: kGeometry; names a polygon of it.
Expected<void> check_light(const PreparedScene& scene, const Scene* names,
                           const std::vector<TableObject>& objects, const LightPoint& light);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_SOLID_CHECKS_H
