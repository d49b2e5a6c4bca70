// SPDX-License-Identifier: GPL-3.0-or-later
// Points, planes and rays in rationals, for tests that find an answer again without any kernel. On
// the grid of a prepared scene, a point light is (position, 1) and a directional one (to_light, 0).
#ifndef GNOMON_TESTS_SUPPORT_EXACT_SPACE_H
#define GNOMON_TESTS_SUPPORT_EXACT_SPACE_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon::test {

using Rational3 = std::array<mpq_class, 3>;
using RationalLoop = std::vector<Rational3>;

inline Rational3 difference(const Rational3& a, const Rational3& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
inline Rational3 cross_product(const Rational3& a, const Rational3& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}
inline mpq_class dot_product(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Rational3 between(const Rational3& a, const Rational3& b, const mpq_class& t) {
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = a[k] + t * (b[k] - a[k]);
  return result;
}

/// normal . x - offset, positive in front.
struct RationalPlane {
  Rational3 normal;
  mpq_class offset;

  static RationalPlane through(const Rational3& normal, const Rational3& point) {
    return {normal, dot_product(normal, point)};
  }
  mpq_class value(const Rational3& point) const { return dot_product(normal, point) - offset; }
  RationalPlane opposite() const {
    return {{mpq_class(-normal[0]), mpq_class(-normal[1]), mpq_class(-normal[2])},
            mpq_class(-offset)};
  }
};

/// Twice the area vector.
inline Rational3 area_vector(const RationalLoop& loop) {
  Rational3 sum;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Rational3 own =
        cross_product(difference(loop[i - 1], loop[0]), difference(loop[i], loop[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += own[k];
  }
  return sum;
}
inline RationalPlane plane_of(const RationalLoop& loop) {
  return RationalPlane::through(area_vector(loop), loop[0]);
}

/// The part of a convex loop in front of a plane; empty if that has no area.
inline RationalLoop in_front(const RationalLoop& loop, const RationalPlane& plane) {
  std::vector<mpq_class> values;
  for (const Rational3& point : loop) values.push_back(plane.value(point));
  RationalLoop result;
  if (std::none_of(values.begin(), values.end(), [](const mpq_class& v) { return v > 0; })) {
    return result;
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t next = i + 1 == loop.size() ? 0 : i + 1;
    if (values[i] >= 0) result.push_back(loop[i]);
    if (sgn(values[i]) * sgn(values[next]) < 0) {
      result.push_back(between(loop[i], loop[next], values[i] / (values[i] - values[next])));
    }
  }
  return result;
}

inline Rational3 grid_position(const PreparedScene& scene, VertexId vertex) {
  const GridPositions& grid = scene.geometry.grid;
  return {mpq_class(grid.at(vertex, 0)), mpq_class(grid.at(vertex, 1)),
          mpq_class(grid.at(vertex, 2))};
}
/// On the grid, counter-clockwise seen from the part's front.
inline RationalLoop grid_loop(const PreparedScene& scene, std::uint32_t part) {
  RationalLoop loop;
  for (const VertexId vertex : scene.loop(scene.parts[part])) {
    loop.push_back(grid_position(scene, vertex));
  }
  return loop;
}

/// On the grid, as a homogeneous point.
struct RationalLight {
  Rational3 point;
  int weight = 1;  // 0: a direction

  explicit RationalLight(const LightPoint& light) : weight(light.directional ? 0 : 1) {
    for (std::size_t k = 0; k < 3; ++k) point[k] = light.grid[k];
  }
  Rational3 from(const Rational3& x) const { return weight == 0 ? point : difference(point, x); }
  int side_of(const RationalPlane& plane) const {
    return sgn(dot_product(plane.normal, point) - weight * plane.offset);
  }
};

/// Whether the interior of the convex loop `near` hides some of `far`: whether an open segment from
/// a point of `far`, off its border, to the light meets `near` off its border. What it hides is the
/// open cone of `near` from the light, behind the plane of `near`.
inline bool hides(const RationalLoop& near, const RationalLoop& far, const RationalLight& light) {
  RationalPlane plane = plane_of(near);
  const int side = light.side_of(plane);
  if (side == 0) return false;  // seen edge on
  if (side < 0) plane = plane.opposite();
  RationalLoop hidden = in_front(far, plane.opposite());
  for (std::size_t i = 0; i < near.size() && !hidden.empty(); ++i) {
    const Rational3& from = near[i];
    const Rational3& to = near[(i + 1) % near.size()];
    RationalPlane wall =
        RationalPlane::through(cross_product(difference(to, from), light.from(from)), from);
    // Counter-clockwise seen from the light, the inside is behind this product.
    if (side > 0) wall = wall.opposite();
    hidden = in_front(hidden, wall);
  }
  return !hidden.empty();
}

/// What a ray meets first.
struct FirstMet {
  bool on_border = false;             // a border is met, or two planes in one point: no answer
  std::optional<std::uint32_t> part;  // coplanar parts that overlap: the last of them
};

/// Of all parts of the scene, whichever way they face, by a ray from `eye` along `direction` (on
/// the grid). By the definition: every part is met or not, and the least distance counts.
inline FirstMet first_met(const PreparedScene& scene, const Rational3& eye,
                          const Rational3& direction) {
  FirstMet result;
  mpq_class nearest;
  PlaneId plane_of_nearest = 0;
  for (std::uint32_t index = 0; index < scene.parts.size(); ++index) {
    const RationalLoop loop = grid_loop(scene, index);
    const RationalPlane plane = plane_of(loop);
    const mpq_class slope = dot_product(plane.normal, direction), at_eye = plane.value(eye);
    if (slope == 0) {
      // Along the plane: nothing, or an edge-on view of a part whose plane holds the eye.
      if (at_eye == 0) result.on_border = true;
      continue;
    }
    const mpq_class t = -at_eye / slope;
    if (t <= 0) continue;
    Rational3 point;
    for (std::size_t k = 0; k < 3; ++k) point[k] = eye[k] + t * direction[k];
    int inside = 1;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Rational3& from = loop[i];
      const Rational3& to = loop[(i + 1) % loop.size()];
      const Rational3 inward = cross_product(plane.normal, difference(to, from));
      inside = std::min(inside, sgn(dot_product(inward, difference(point, from))));
    }
    if (inside < 0) continue;
    if (inside == 0) result.on_border = true;
    const PlaneId own = scene.parts[index].plane;
    if (result.part && t == nearest && own != plane_of_nearest) result.on_border = true;
    if (!result.part || t < nearest || (t == nearest && own == plane_of_nearest)) {
      result.part = index;
      nearest = t;
      plane_of_nearest = own;
    }
  }
  return result;
}

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_EXACT_SPACE_H
