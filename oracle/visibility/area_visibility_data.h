// SPDX-License-Identifier: GPL-3.0-or-later
// The inside of AreaVisibility: the scene's polygons and the light in rational numbers, and what
// both of its questions are made of.
#ifndef GNOMON_ORACLE_VISIBILITY_AREA_VISIBILITY_DATA_H
#define GNOMON_ORACLE_VISIBILITY_AREA_VISIBILITY_DATA_H

#include <gmpxx.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "gnomon/oracle/area_visibility.h"
#include "oracle/geometry/space_loop.h"

namespace gnomon::oracle {
namespace area_view {

using space::area_along;
using space::cross;
using space::dot;
using space::Loop;
using space::minus;
using space::negated;

using Vector = RationalPoint;

/// normal . (x - base) >= 0.
struct HalfSpace {
  Vector normal, base;
  mpq_class at(const Vector& point) const { return dot(normal, minus(point, base)); }
};

/// What of a convex loop is in the closed half-space: also what has no area, down to a point.
inline Loop closed_part(const Loop& loop, const HalfSpace& half) {
  std::vector<mpq_class> values;
  bool outside = false;
  for (const Vector& point : loop) {
    values.push_back(half.at(point));
    outside = outside || values.back() < 0;
  }
  if (!outside) return loop;
  Loop result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    if (values[i] >= 0) result.push_back(loop[i]);
    if (sgn(values[i]) * sgn(values[j]) >= 0) continue;
    const mpq_class t = values[i] / (values[i] - values[j]);
    Vector crossing;
    for (int k = 0; k < 3; ++k) crossing[k] = loop[i][k] + t * (loop[j][k] - loop[i][k]);
    result.push_back(std::move(crossing));
  }
  return result;
}

struct Polygon3 {
  Loop loop;
  Vector normal;  // of the front
  bool two_sided = false, casts = false;
};

inline Vector loop_normal(const Loop& loop) {
  return cross(minus(loop[1], loop[0]), minus(loop[2], loop[0]));
}

/// Where a point of the polygon's plane lies: 1 inside, 0 on the border, -1 outside.
inline int place_in(const Polygon3& polygon, const Vector& point) {
  int result = 1;
  for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
    const Vector& a = polygon.loop[i];
    const Vector edge = minus(polygon.loop[(i + 1) % polygon.loop.size()], a);
    result = std::min(result, sgn(dot(cross(polygon.normal, edge), minus(point, a))));
  }
  return result;
}

/// The half-space of the plane through a point and an edge of a polygon that holds the polygon.
/// Requires: the point is not in the polygon's plane.
inline HalfSpace through(const Vector& point, const Polygon3& polygon, std::size_t edge) {
  const std::size_t size = polygon.loop.size();
  const Vector &a = polygon.loop[edge], &b = polygon.loop[(edge + 1) % size];
  HalfSpace half{cross(minus(a, point), minus(b, point)), point};
  if (half.at(polygon.loop[(edge + 2) % size]) < 0) half.normal = negated(half.normal);
  return half;
}

/// A line in space, equal for all pairs of its points: its direction, 1 along the first axis along
/// which it runs, and its moment about the origin.
struct Line {
  std::array<mpq_class, 6> numbers;
  int axis = 0;

  Line(const Vector& a, const Vector& b) {
    Vector direction = minus(b, a);
    while (direction[axis] == 0) ++axis;
    const mpq_class length = direction[axis];
    for (mpq_class& c : direction) c /= length;
    const Vector moment = cross(a, direction);
    std::copy(direction.begin(), direction.end(), numbers.begin());
    std::copy(moment.begin(), moment.end(), numbers.begin() + 3);
  }
  friend bool operator<(const Line& a, const Line& b) { return a.numbers < b.numbers; }
};

/// An edge on its line: its lower and upper end, and how it bounds what is on one of the line's
/// sides.
struct EdgeOnLine {
  const Vector *low = nullptr, *high = nullptr;
  int sign = 1;
  std::size_t facet = 0;
};

}  // namespace area_view

struct AreaVisibility::Data {
  using Vector = area_view::Vector;
  using Loop = area_view::Loop;
  using HalfSpace = area_view::HalfSpace;
  using Polygon3 = area_view::Polygon3;
  using Line = area_view::Line;
  using EdgeOnLine = area_view::EdgeOnLine;

  std::vector<Polygon3> parts;
  std::vector<std::uint32_t> all;  // parts
  Loop light;
  Vector light_normal;
  mpq_class light_area;

  mpq_class height(const Vector& point) const {
    return space::dot(light_normal, space::minus(point, light[0]));
  }
  mpq_class area_of(const Loop& loop) const { return space::area_along(light_normal, loop); }
  /// A_R; empty without area, or if the side does not receive.
  Loop seen_by(std::uint32_t receiver, Side side) const;
  bool coplanar(const Polygon3& a, const Polygon3& b) const {
    return std::all_of(a.loop.begin(), a.loop.end(), [&](const Vector& vertex) {
      return space::dot(b.normal, space::minus(vertex, b.loop[0])) == 0;
    });
  }
  /// Where light may cross one edge on its way to a convex polygon: half-spaces across the light's
  /// plane whose intersection holds all places where it arrives from. `none`: it cannot cross.
  struct Crossing {
    enum class Kind : std::uint8_t { kNone, kSome, kUnknown } kind = Kind::kNone;
    std::vector<HalfSpace> bounds;
  };
  Crossing crossing(const Vector& u, const Vector& v, const Loop& polygon) const;
  /// A sheet of connected casters, all of them between the polygon and the light, one face
  /// forward.
  struct Facet {
    std::uint32_t part = 0;
    bool front = true;  // blocks with its front
  };
  /// The edges of facets by the lines that they are on.
  std::map<Line, std::vector<EdgeOnLine>> lines_of(const std::vector<Facet>& facets) const;
  /// The facets that are connected over edges or parts of edges.
  std::vector<std::vector<Facet>> sheets_of(const std::vector<Facet>& facets) const;
  /// What bounds a sheet: stretches of lines that have facets on one side alone.
  std::vector<std::pair<Vector, Vector>> border_of(const std::vector<Facet>& sheet) const;
  std::vector<Loop> without_sheet(const std::vector<Loop>& loops, const std::vector<Facet>& sheet,
                                  const Loop& polygon) const;
  /// What is left of loops in the light's plane without one convex loop.
  std::vector<Loop> without(const std::vector<Loop>& loops, const Loop& hidden) const;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_AREA_VISIBILITY_DATA_H
