// SPDX-License-Identifier: LGPL-3.0-or-later
// Solids and furniture that several generators build with. Faces look outwards.
#ifndef GNOMON_SCENE_GENERATE_SCENE_SHAPES_H
#define GNOMON_SCENE_GENERATE_SCENE_SHAPES_H

#include <array>
#include <string>
#include <vector>

#include "scene/generate/scene_maker.h"

namespace gnomon::scene_detail {

/// One polygon called floor in the plane z = low.z, that looks up.
void floor_at(SceneMaker& maker, Int3 low, Int3 high);

/// Four triangles, whatever the orientation of the corners.
void tetrahedron(SceneMaker& maker, const std::string& id, const std::array<Int3, 4>& v);

/// 8 polygons on a hexagon round `middle`.
void hexagonal_prism(SceneMaker& maker, const std::string& id, Int3 middle, std::int64_t reach,
                     std::int64_t height);

/// On a convex foot of n corners, counter-clockwise seen from above: n + 2 polygons.
void upright_prism(SceneMaker& maker, const std::string& id, const std::vector<Int3>& foot,
                   std::int64_t height);

/// 8 triangles.
void octahedron(SceneMaker& maker, const std::string& id, Int3 middle, std::int64_t reach);

/// Top of 6 faces and 4 legs of 4 sides each that end under it: 22 polygons.
void table(SceneMaker& maker, const std::string& id, Int3 o, std::int64_t width, std::int64_t depth,
           std::int64_t height);

/// A low table with a back of 6 faces: 28 polygons.
void chair(SceneMaker& maker, const std::string& id, Int3 o);

/// The 6 faces of the box [0, high], seen from inside.
void room_shell(SceneMaker& maker, Int3 high);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GENERATE_SCENE_SHAPES_H
