// SPDX-License-Identifier: GPL-3.0-or-later
// Convex loops of a plane in extended precision, in scene units: what is cheap to cut where a bound
// of the error is far below what has to be told apart.
//
// Exactness: none. A coordinate is off by at most kPlanarError times the greatest distance of its
// plane's points from the origin of the scene (plane_frame.h); a cut adds less than that again.
#ifndef GNOMON_ORACLE_GEOMETRY_PLANAR_LOOP_H
#define GNOMON_ORACLE_GEOMETRY_PLANAR_LOOP_H

#include <span>
#include <vector>

namespace gnomon::oracle {

struct PlanarPoint {
  long double x = 0, y = 0;
};
using PlanarLoop = std::vector<PlanarPoint>;

/// a x + b y + c, the distance from the line: positive inside.
struct PlanarLine {
  long double a = 0, b = 0, c = 0;
  long double at(const PlanarPoint& point) const { return a * point.x + b * point.y + c; }
  PlanarLine opposite() const { return {-a, -b, -c}; }
  /// The same half-plane with its border moved outwards.
  PlanarLine grown(long double distance) const { return {a, b, c + distance}; }
};

struct PlanarBox {
  PlanarPoint low, high;
  bool meets(const PlanarBox& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y;
  }
};

/// Requires: at least one point.
PlanarBox box_of(const PlanarLoop& loop, long double margin = 0);
PlanarBox box_of(const PlanarPoint& a, const PlanarPoint& b);
bool is_finite(const PlanarLoop& loop);
/// The line through two points with the inside to its left; all zero if they are one point.
PlanarLine line_through(const PlanarPoint& a, const PlanarPoint& b);
/// Of a counter-clockwise convex loop; edges without length have none.
std::vector<PlanarLine> lines_of(const PlanarLoop& loop);
/// The convex hull, counter-clockwise; fewer than three points if all are on one line.
PlanarLoop hull_of(PlanarLoop points);

/// Signed: positive if counter-clockwise.
long double area_of(const PlanarLoop& loop);
long double perimeter_of(const PlanarLoop& loop);
/// A disc of a greater diameter than `width` is in a convex loop.
bool is_wider(const PlanarLoop& loop, long double width);
/// Of the narrowest strip along an edge of their hull that holds some points; infinite if they are
/// one point.
long double strip_width_of(const PlanarLoop& points);

/// What is left of a convex loop inside; empty if nothing is.
PlanarLoop cut(const PlanarLoop& loop, const PlanarLine& line);
/// What is left of convex loops without an intersection of half-planes, as convex loops. No
/// half-planes: nothing is left.
std::vector<PlanarLoop> without(std::vector<PlanarLoop> loops, std::span<const PlanarLine> bounds);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_PLANAR_LOOP_H
