// SPDX-License-Identifier: LGPL-3.0-or-later
// How two polygons of a scene touch, and whether a point is inside of a closed surface: signs of
// integers on the grid.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_POLYGON_CONTACT_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_POLYGON_CONTACT_H

#include <cstdint>
#include <span>

#include "algorithms/ridge_edges/light_directions.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Whether the insides of two coplanar parts have an area in common.
bool overlap_in_plane(const PreparedScene& scene, const Part& first, const Part& second);

/// Whether a part has points right behind the inside of a face: it goes through the face, or
/// touches it from behind.
bool comes_behind(const PreparedScene& scene, const Part& part, const Part& face);

/// Whether a point is on a part or its border. `point`: three times a position of the grid.
bool is_on_part(const PreparedScene& scene, const Part& part, const DirectionVector& point);

/// How often closed surfaces of parts, oriented by their fronts, go round a point: 1 inside of a
/// solid, -1 inside of a room whose walls face inwards, 0 outside. `point` as above. Requires: the
/// point is on no part.
int winding_number(const PreparedScene& scene, std::span<const std::uint32_t> parts,
                   const DirectionVector& point);

/// The winding number right beside a part of them, before its front or behind it.
struct WindingBeside {
  int winding = 0;
  bool in_front = false;
};
WindingBeside winding_beside(const PreparedScene& scene, std::span<const std::uint32_t> parts,
                             const Part& part);

/// Of the volume of a closed surface: positive if the fronts are outside.
int sign_of_volume(const PreparedScene& scene, std::span<const std::uint32_t> parts);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_POLYGON_CONTACT_H
