// SPDX-License-Identifier: LGPL-3.0-or-later
// The canonical name of a plane on the scene's grid: two parts lie in one plane if and only if the
// names are equal.
#ifndef GNOMON_SCENE_GEOMETRY_PLANE_KEY_H
#define GNOMON_SCENE_GEOMETRY_PLANE_KEY_H

#include <cstdint>
#include <utility>

#include "scene/geometry/loop_geometry.h"

namespace gnomon::scene_detail {

/// A plane, canonically: n . p = offset.
template <class Int>
struct PlaneKey {
  Vec3<Int> normal;  // primitive, first non-zero component positive
  Int offset;
  bool flipped;  // the part's front is where n . p < offset

  /// The key of the plane of a part, given by the part's normal and a point `a` of it.
  PlaneKey(Vec3<Int> normal_of_part, const Vec3<Int>& a) : normal(std::move(normal_of_part)) {
    Int common = gcd_of(gcd_of(normal.x, normal.y), normal.z);
    const Int& leading = normal.x != 0 ? normal.x : normal.y != 0 ? normal.y : normal.z;
    flipped = leading < 0;
    if (flipped) common = -common;
    if (common != 1) {
      for (Int* component : {&normal.x, &normal.y, &normal.z}) {
        if (*component != 0) *component /= common;
      }
    }
    offset = dot(normal, a);
  }
  /// Do both keys name the same set of points? Fronts may look opposite ways.
  bool same_plane(const PlaneKey& other) const {
    return normal.x == other.normal.x && normal.y == other.normal.y && normal.z == other.normal.z &&
           offset == other.offset;
  }
  std::uint64_t hash() const {
    std::uint64_t result = 0;
    for (int k = 0; k < 3; ++k) result = hash_into(result, normal[k]);
    return hash_into(result, offset);
  }
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GEOMETRY_PLANE_KEY_H
