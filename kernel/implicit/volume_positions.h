// SPDX-License-Identifier: LGPL-3.0-or-later
// Where a corner of volume space is: enclosed, as seen from a vertex, exactly, or as nearest
// doubles.
//
// Guarantee: enclosures are proven (VolumeBounds); what is called exact or nearest is.
#ifndef GNOMON_KERNEL_IMPLICIT_VOLUME_POSITIONS_H
#define GNOMON_KERNEL_IMPLICIT_VOLUME_POSITIONS_H

#include <array>

#include "kernel/implicit/volume_points.h"
#include "kernel/signs/ball.h"

namespace gnomon {

class VolumePositions : public VolumePoints {
 public:
  /// Enclosures in grid units times 2^-b; of made vertices by what their doubles are known to.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// The same as seen from vertex `origin`, with errors that are small against the distances from
  /// it: areas of small polygons are then not measured on the scale of the scene.
  std::array<Ball, 3> offset(VertexId origin, const Corner<Vertex>& corner) const;
  /// Scene units.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// The nearest doubles of exact_position(), mostly from some 100 bits.
  std::array<double, 3> nearest_position(const Corner<Vertex>& corner) const;

 protected:
  using VolumePoints::VolumePoints;

 private:
  /// Coordinates of a made corner in scene units, as far as they are known.
  struct PartlyKnown {
    std::array<double, 3> x{};
    std::array<bool, 3> known{};
  };
  std::array<Ball, 3> input_offset(VertexId from, VertexId to) const;
  std::array<Ball, 3> exact_offset(VertexId origin, const Corner<Vertex>& corner) const;
  std::array<Ball, 3> edge_offset(VertexId origin, const Corner<Vertex>& corner) const;
  PartlyKnown shared_coordinates(const Corner<Vertex>& corner) const;
  bool have_same_coordinate(int axis, VertexId a, VertexId b, VertexId c) const;
  void add_nearest(const Corner<Vertex>& corner, PartlyKnown& point) const;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_VOLUME_POSITIONS_H
