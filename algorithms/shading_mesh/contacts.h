// SPDX-License-Identifier: LGPL-3.0-or-later
// Finds where casters touch or cross the plane of a receiver: there illumination jumps, and a
// vertex has two values. The foot of a wall is lit on one side of the wall and dark on the other.
//
// Exactness: candidates by a bounding-volume hierarchy with a margin, then exact tests.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_CONTACTS_H
#define GNOMON_ALGORITHMS_SHADING_MESH_CONTACTS_H

#include <gmpxx.h>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/grid.h"
#include "algorithms/shading_mesh/points.h"
#include "algorithms/shadow_volumes/caster_tree.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

class Contacts {
 public:
  explicit Contacts(const PreparedScene& scene);

  /// Finds the casters that these points are on; each point is looked at once.
  void find(const PointTable& points, std::span<const std::uint32_t> vertices);

  /// Whether a caster that the vertex is on, not coplanar with the face, may hide light from the
  /// face: `inside`, a point inside of the face, is behind a side of it that casts. Requires: the
  /// vertex was looked at.
  bool is_behind(std::uint32_t vertex, const MeshFace& face, const ExactPoint& inside) const;
  /// Whether the vertex is on any caster that is not coplanar with the face.
  bool touches(std::uint32_t vertex, const MeshFace& face) const;

 private:
  bool is_on(const ExactPoint& point, std::uint32_t part) const;

  const PreparedScene& scene_;
  CasterTree tree_;
  std::vector<std::uint8_t> looked_at_;                                  // by vertex
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> parts_;  // by vertex, if any
  std::unordered_map<PlaneId, MeshPlane> planes_;                        // of `parts_`
};

/// A point inside of a face: the mean of three corners that are not collinear.
ExactPoint inner_point(std::span<const std::uint32_t> loop, const PointTable& points);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_CONTACTS_H
