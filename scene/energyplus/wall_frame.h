// SPDX-License-Identifier: LGPL-3.0-or-later
// What windows, overhangs and fins are placed by: the corner of a surface, the directions along it,
// up in it and out of it. EnergyPlus says all of them by azimuth and tilt, and here they come from
// the surface's own vertices, exactly where they are decimals.
#ifndef GNOMON_SCENE_ENERGYPLUS_WALL_FRAME_H
#define GNOMON_SCENE_ENERGYPLUS_WALL_FRAME_H

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/model/decimal_vector.h"

namespace gnomon::energy {

using namespace decimals;

/// Which corner the vertices of surfaces begin with, by GlobalGeometryRules.
enum class FirstCorner : std::uint8_t { kUpperLeft, kLowerLeft, kLowerRight, kUpperRight };

/// Where the lower left corner stands in a counter-clockwise loop of so many vertices.
std::size_t lower_left(FirstCorner first, std::size_t vertices);

struct WallFrame {
  Position corner;          // the lower left one, seen from outside
  Position along;           // unit vector, horizontal, to the right
  Position up;              // unit vector in the surface
  Position out;             // unit normal
  Position out_in_plan;     // unit vector, the horizontal direction of `out`
  bool is_rounded = false;  // is one of them not of length 1 exactly?
};

/// Of a counter-clockwise loop; nothing if it is horizontal or has no area.
std::optional<WallFrame> wall_frame(const std::vector<Position>& loop, FirstCorner first);
/// Of a surface that faces an azimuth (degrees from north, clockwise) with a tilt (degrees from
/// facing up), whose corner is there.
WallFrame wall_frame(const Number& azimuth, const Number& tilt, Position corner);

/// A rectangle counter-clockwise from its lower left corner, that is `right` and `above` from the
/// frame's.
std::vector<Position> rectangle(const WallFrame& frame, const Number& right, const Number& above,
                                const Number& length, const Number& height);

}  // namespace gnomon::energy

#endif  // GNOMON_SCENE_ENERGYPLUS_WALL_FRAME_H
