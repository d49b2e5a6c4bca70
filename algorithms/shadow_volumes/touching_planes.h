// SPDX-License-Identifier: LGPL-3.0-or-later
// Planes through an edge of one convex thing and a vertex of another that leave both on one side
// each, or both on the same: the half-spaces of shadow volumes.
//
// `Corners`: what has size() and corner(i), such as a loop. Planes that are made and not returned
// are released.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_TOUCHING_PLANES_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_TOUCHING_PLANES_H

#include <array>
#include <cstdint>
#include <vector>

#include "gnomon/kernel/orientation.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// A vertex as a corner of no loop, of which no edge and no plane is known. It must outlive the
/// corner.
template <class Vertex>
Corner<Vertex> lone_corner(const Vertex& vertex) {
  constexpr PlaneId kNoSupport = 0xffffffffu;
  return {{}, vertex, {}, kNoSupport};
}
template <class Vertex>
Corner<Vertex> lone_corner(const Vertex&&) = delete;

/// The usable corner that extreme_plane() is likely to end with, by the doubles that vertices have
/// for a filter; the first usable one where they have none.
template <class CornerOf, class Corners, class Usable>
std::uint32_t likely_extreme(const CornerOf& a, const CornerOf& b, const Corners& corners,
                             Side beyond, const Usable& usable) {
  std::uint32_t best = 0;
  while (best < corners.size() && !usable(best)) ++best;
  if constexpr (requires { a.vertex.bound; }) {
    using Vector = std::array<double, 3>;
    const auto from_a = [&](const CornerOf& corner) -> Vector {
      return {corner.vertex.x[0] - a.vertex.x[0], corner.vertex.x[1] - a.vertex.x[1],
              corner.vertex.x[2] - a.vertex.x[2]};
    };
    const double sign = beyond == Side::kFront ? 1 : -1;
    const Vector edge = from_a(b);
    const auto normal_through = [&](const Vector& p) -> Vector {
      return {sign * (edge[1] * p[2] - edge[2] * p[1]), sign * (edge[2] * p[0] - edge[0] * p[2]),
              sign * (edge[0] * p[1] - edge[1] * p[0])};
    };
    Vector normal{};
    for (std::uint32_t i = best; i < corners.size(); ++i) {
      if (!usable(i)) continue;
      const Vector p = from_a(corners.corner(i));
      if (i != best && !(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] > 0)) continue;
      normal = normal_through(p);
      best = i;
    }
  }
  return best;
}

/// Of the planes through a, b and those corners that `usable` accepts the one that no usable corner
/// is on the side `beyond` of; they must lie in a half-turn around a, b. Invalid if all are on the
/// line.
template <VolumeSpaceModel Space, class CornerOf, class Corners, class Usable>
PlaneRef extreme_plane(Space& space, const CornerOf& a, const CornerOf& b, const Corners& corners,
                       Side beyond, const Usable& usable) {
  const std::uint32_t mark = space.plane_mark();
  const std::uint32_t first = likely_extreme(a, b, corners, beyond, usable);
  if (first >= corners.size()) return {};
  PlaneRef plane = space.add_plane(a, b, corners.corner(first));
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    if (i == first || !usable(i)) continue;
    const CornerOf corner = corners.corner(i);
    if (plane.valid() && space.side_of_plane(plane, corner) != beyond) continue;
    space.release_planes(mark);
    plane = space.add_plane(a, b, corner);
  }
  return plane;
}

template <VolumeSpaceModel Space, class Corners>
std::uint32_t corners_on(Space& space, const Corners& corners, PlaneRef plane) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    if (space.side_of_plane(plane, corners.corner(i)) == Side::kOn) ++count;
  }
  return count;
}

/// Is a corner that lies in some other plane, as `sides` tell, on that side of this one?
template <VolumeSpaceModel Space, class Corners>
bool any_on_plane(Space& space, const Corners& corners, const std::vector<Side>& sides,
                  PlaneRef plane, Side asked) {
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    if (sides[i] == Side::kOn && space.side_of_plane(plane, corners.corner(i)) == asked) {
      return true;
    }
  }
  return false;
}

/// On which side of a plane corners are; kOn: on both, or all in it.
template <VolumeSpaceModel Space, class Corners>
Side one_side(Space& space, const Corners& corners, PlaneRef plane) {
  bool front = false, back = false;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const Side side = space.side_of_plane(plane, corners.corner(i));
    front = front || side == Side::kFront;
    back = back || side == Side::kBack;
  }
  return front == back ? Side::kOn : front ? Side::kFront : Side::kBack;
}

/// The plane turned so that what casts is in front, if the light is then behind it; else invalid.
template <VolumeSpaceModel Space, class Corners, class Light>
PlaneRef separating(Space& space, const Corners& caster, const Light& light, PlaneRef plane) {
  const Side caster_side = one_side(space, caster, plane);
  if (caster_side == Side::kOn || one_side(space, light, plane) != opposite(caster_side)) return {};
  return caster_side == Side::kFront ? plane : -plane;
}

/// Adds the planes through an edge of the light and a vertex of what casts that separate the two.
/// Planes that hold two vertices of that are to be found elsewhere. `in_front`: all of it is in
/// front of the light's plane.
template <VolumeSpaceModel Space, class Corners, class Light>
void add_light_edges(Space& space, const Corners& caster, const Light& light, bool in_front,
                     std::vector<PlaneRef>& found) {
  for (std::uint32_t i = 0; i < light.size(); ++i) {
    // The light is in front of the planes through a, b and points in front of the light.
    const auto a = light.corner(light.next(i)), b = light.corner(i);
    if (in_front) {
      const std::uint32_t mark = space.plane_mark();
      const PlaneRef plane =
          extreme_plane(space, a, b, caster, Side::kFront, [](std::uint32_t) { return true; });
      if (plane.valid() && corners_on(space, caster, plane) == 1) {
        found.push_back(-plane);
      } else {
        space.release_planes(mark);
      }
      continue;
    }
    // A caster on both sides of the light's plane may be touched twice.
    for (std::uint32_t k = 0; k < caster.size(); ++k) {
      const std::uint32_t mark = space.plane_mark();
      const PlaneRef plane = space.add_plane(a, b, caster.corner(k));
      PlaneRef turned;
      if (plane.valid() && corners_on(space, caster, plane) == 1) {
        turned = separating(space, caster, light, plane);
      }
      if (turned.valid()) {
        found.push_back(turned);
      } else {
        space.release_planes(mark);
      }
    }
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_TOUCHING_PLANES_H
