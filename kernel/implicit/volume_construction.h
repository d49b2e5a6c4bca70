// SPDX-License-Identifier: LGPL-3.0-or-later
// New planes of shadow volumes through corners: of casters and of lights, whole or cut.
//
// Guarantee: exact on every input. Reference: Chin & Feiner 1992, sec. 3; docs/exactness.md,
// "Shadow volumes of area lights".
#ifndef GNOMON_KERNEL_IMPLICIT_VOLUME_CONSTRUCTION_H
#define GNOMON_KERNEL_IMPLICIT_VOLUME_CONSTRUCTION_H

#include <array>
#include <optional>

#include "kernel/implicit/volume_positions.h"

namespace gnomon {

class VolumeConstruction : public VolumePositions {
 public:
  /// Through three points, counter-clockwise seen from the front; not valid() if they are on a
  /// line. Degree: 2 for three input vertices, 5 or 8 with a corner that one or two support planes
  /// cut off a light. Bits: support_normal_bits(), cut_once_normal_bits(), cut_twice_normal_bits().
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b, const Corner<Vertex>& c);
  /// The same with the third point at infinity, where a directional light is (or at a point light).
  /// Bits: directional_normal_bits().
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b, const LightPoint& light);
  /// Exactly where the coordinate is `value` 2^b grid units. Requires: value in [0, 1].
  PlaneRef add_axis_plane(int axis, double value);

 protected:
  using VolumePositions::VolumePositions;

 private:
  std::optional<PlaneRef> add_through_made(VertexId p, VertexId q, const Corner<Vertex>& made);
  std::optional<PlaneRef> add_through_edge(const Corner<Vertex>& p, const Corner<Vertex>& q,
                                           const Corner<Vertex>& r);
  std::optional<PlaneRef> add_through_line(VertexId v, const Plane& first, const Plane& second);
  std::optional<PlaneRef> add_along(VertexId p, VertexId q, const LightPoint& light);
  PlaneRef add_spanned(const Homogeneous<mpz_class>& point, const Vector3<mpz_class>& u,
                       const Vector3<mpz_class>& v);
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_VOLUME_CONSTRUCTION_H
