// SPDX-License-Identifier: LGPL-3.0-or-later
// A shadow volume has no end, so it is cut out of a polyhedron: the box of the whole scene, in
// front of the light's plane. A point outside the box is in no receiver, and a point behind the
// light is in the umbra whatever the casters do.
//
// A receiver that lies in a face of the box is seen by area lights from inside only, because they
// are in the box, too. A lamp or a sun may see it from outside, where nothing is in its way.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_BOUNDING_BOX_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_BOUNDING_BOX_H

#include <array>
#include <cstdint>
#include <span>

#include "algorithms/volume_trees/polyhedron.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// Makes the box between two points, in fractions of the grid's extent.
template <VolumeSpaceModel Space>
Polyhedron<typename Space::Vertex> make_box(Space& space, const std::array<double, 3>& low,
                                            const std::array<double, 3>& high) {
  Polyhedron<typename Space::Vertex> box;
  std::array<std::array<PlaneRef, 2>, 3> planes;  // inside in front
  for (int axis = 0; axis < 3; ++axis) {
    planes[axis] = {space.add_axis_plane(axis, low[axis]), -space.add_axis_plane(axis, high[axis])};
  }
  // Vertex 4 z + 2 y + x, each 0 (low) or 1 (high).
  for (std::uint32_t v = 0; v < 8; ++v) {
    std::array<double, 3> fractions;
    for (std::uint32_t k = 0; k < 3; ++k) fractions[k] = (v >> k & 1) != 0 ? high[k] : low[k];
    box.vertices.push_back(space.axis_point(fractions));
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::uint32_t end = 0; end < 2; ++end) {
      const auto first = static_cast<std::uint32_t>(box.corners.size());
      // Counter-clockwise from outside: u before v at the high end, v before u at the low one.
      const std::uint32_t a = end == 1 ? u : v, b = end == 1 ? v : u;
      const std::uint32_t base = end << axis;
      box.corners.push_back({base, planes[b][0]});
      box.corners.push_back({base | 1u << a, planes[a][1]});
      box.corners.push_back({base | 1u << a | 1u << b, planes[b][1]});
      box.corners.push_back({base | 1u << b, planes[a][0]});
      box.faces.push_back({planes[axis][end], first, 4, false});
    }
  }
  return box;
}

/// Makes the part of `box` in front of all planes, which become own faces; it may be empty.
template <VolumeSpaceModel Space>
void cut_volume(Space& space, const Polyhedron<typename Space::Vertex>& box,
                std::span<const PlaneRef> planes, PolyhedronSplitter<Space>& splitter,
                Polyhedron<typename Space::Vertex>& volume) {
  volume = box;
  for (const PlaneRef plane : planes) {
    if (volume.empty()) return;
    splitter.clip(space, plane, true, volume);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_BOUNDING_BOX_H
