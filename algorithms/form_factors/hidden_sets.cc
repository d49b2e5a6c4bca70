// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/form_factors/hidden_sets.h"

#include <algorithm>

namespace gnomon {

namespace {

struct Edge {
  Vector a{}, b{};
};

Edge edge_of(const BlockingSide& caster, std::size_t i) {
  return {caster.loop[i], caster.loop[i + 1 == caster.loop.size() ? 0 : i + 1]};
}

/// What a cross product of differences of points is off by in a scene of extent 1: some nine units
/// are more than its roundings are.
constexpr double kCrossError = 2e-15;
/// Stands for a length of 0 where it is divided by; the margin is then beyond all points.
constexpr double kShortestCross = 1e-300;

/// The half-space through a point behind the caster and an edge, the caster in front.
HalfSpace through(const Edge& edge, const Vector& point) {
  const Vector across = cross(edge.a - point, edge.b - point);
  // Close to the edge's line the direction is less certain.
  const double size = std::max(length(across), kShortestCross);
  const Vector normal = 1 / size * across;
  return {normal, dot(normal, edge.a), kMargin + kCrossError / size};
}

/// How far inside of an edge's line a point of the caster's plane is.
double inside(const BlockingSide& caster, const Edge& edge, const Vector& point) {
  return dot(cross(caster.plane.normal, unit(edge.b - edge.a)), point - edge.a);
}

/// The corners of a cell by their place, and where the cell's edges cross the plane.
struct Places {
  std::vector<Vector> behind, on;
  bool front = false;
};

Places places_of(const BlockingSide& caster, const CellTriangle& cell) {
  Places places;
  std::array<double, 3> height{};
  for (std::size_t k = 0; k < 3; ++k) {
    height[k] = caster.plane.at({cell[k], 1});
    if (height[k] < -kMargin) {
      places.behind.push_back(cell[k]);
    } else if (height[k] > kMargin) {
      places.front = true;
    } else {
      places.on.push_back(cell[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double a = height[k], b = height[next];
    if ((a < -kMargin && b > kMargin) || (a > kMargin && b < -kMargin)) {
      const double s = a / (a - b);
      places.on.push_back((1 - s) * cell[k] + s * cell[next]);
    }
  }
  return places;
}

/// Hidden from all: behind the tightest plane of every edge, so behind all of them.
std::optional<std::vector<HalfSpace>> from_all(const BlockingSide& caster, const Places& places) {
  if (places.front || places.behind.empty()) return std::nullopt;
  std::vector<HalfSpace> cone{caster.plane};
  for (std::size_t i = 0; i < caster.loop.size(); ++i) {
    const Edge edge = edge_of(caster, i);
    for (const Vector& corner : places.on) {
      // From just behind a point of the plane that is outside of an edge, nothing is hidden.
      if (inside(caster, edge, corner) < -kMargin) return std::nullopt;
    }
    for (const Vector& corner : places.behind) cone.push_back(through(edge, corner));
  }
  return cone;
}

/// Hidden from any: behind the loosest plane of every edge.
std::optional<std::vector<HalfSpace>> from_any(const BlockingSide& caster, const Places& places) {
  if (places.behind.empty()) {
    // All of a cell so close to the plane that it may be behind: nothing is known.
    if (places.on.size() == 3 && !places.front) return std::vector{caster.plane};
    return std::nullopt;
  }
  std::vector<HalfSpace> cone{caster.plane};
  for (std::size_t i = 0; i < caster.loop.size(); ++i) {
    const Edge edge = edge_of(caster, i);
    // Close to a point of the plane that is inside of the edge, the edge bounds nothing.
    if (std::ranges::any_of(places.on, [&](const Vector& corner) {
          return inside(caster, edge, corner) > -kMargin;
        })) {
      continue;
    }
    HalfSpace loosest = through(edge, places.behind.front());
    for (std::size_t k = 1; k < places.behind.size(); ++k) {
      if (loosest.at({places.behind[k], 1}) > 0) loosest = through(edge, places.behind[k]);
    }
    cone.push_back(loosest);
  }
  return cone;
}

}  // namespace

HiddenSets hidden_sets(const BlockingSide& caster, const CellTriangle& cell) {
  const Places places = places_of(caster, cell);
  return {from_all(caster, places), from_any(caster, places)};
}

std::optional<std::vector<HalfSpace>> hidden_from(const BlockingSide& caster, const Vector& point) {
  if (!(caster.plane.at({point, 1}) < 0)) return std::nullopt;
  std::vector<HalfSpace> cone{caster.plane};
  for (std::size_t i = 0; i < caster.loop.size(); ++i) {
    cone.push_back(through(edge_of(caster, i), point));
  }
  return cone;
}

}  // namespace gnomon
