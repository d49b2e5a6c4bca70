// SPDX-License-Identifier: GPL-3.0-or-later
// What the rounding of coordinates to doubles excuses (docs: semantics, "Rounding"; proven in
// oracle.md): one rule for all judges of claims. A vertex of a claim that names no exact loop may
// be off by half a unit in the last place in each coordinate, and error that lies within that
// distance of a border, true or claimed, is rounding.
//
// Exactness: the distance is applied to within a tenth.
#ifndef GNOMON_ORACLE_GEOMETRY_ROUNDING_H
#define GNOMON_ORACLE_GEOMETRY_ROUNDING_H

#include <cstdint>
#include <span>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "oracle/geometry/planar_loop.h"

namespace gnomon::oracle {

/// The distance, scene units: sqrt(3)/2 units in the last place of the greatest coordinate of the
/// polygon's vertices; twice that if numbers are decimals, where the text of a double need not be
/// the double itself. Requires: a polygon that has parts.
long double rounding_radius(const Scene& scene, const PreparedScene& prepared,
                            std::uint32_t polygon);

/// Of a claim, of a true class, or of the polygon.
struct Border {
  PlanarPoint a, b;
};

/// Whether all of the points lie within `radius` of one and the same border. Their hull does then,
/// since what is so near a segment is convex.
bool are_near_one(const PlanarLoop& points, std::span<const Border> borders, long double radius);

/// Whether a convex, counter-clockwise piece of error lies within `radius` of some of the borders.
bool is_rounding(const PlanarLoop& error, std::span<const Border> borders, long double radius);

/// No more than this of an area can be rounding near one border.
long double rounding_area(const Border& border, long double radius);

/// A little more than the radius: what is farther is no rounding.
long double rounding_reach(long double radius);

/// Whether a distance is at most `radius`, in the same measure.
bool is_rounding(long double distance, long double radius);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_ROUNDING_H
