// SPDX-License-Identifier: LGPL-3.0-or-later
// The triangle between an edge and the viewer, or the strip from an edge towards a direction, and
// which boxes may meet it. Trees of contour edges and polygons (partition/box_tree.h) are searched
// with it.
//
// Guarantee: conservative. A box that misses() accepts is proven to miss the closed triangle.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_SIGHT_SHAFT_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_SIGHT_SHAFT_H

#include <array>
#include <vector>

#include "algorithms/partition/box.h"
#include "gnomon/kernel/geometry.h"

namespace gnomon {

/// Positions in grid units (on grids of more than 63 bits in units that make them 63), as doubles.
class NearPositions {
 public:
  using Point = std::array<double, 3>;

  NearPositions(const Geometry& geometry, const LightPoint& viewer);

  const Point& operator[](VertexId vertex) const { return points_[vertex]; }
  /// The viewer; of a direction, scaled so that its largest component is 1.
  const Point& viewer() const { return viewer_; }
  bool directional() const { return directional_; }
  /// Of all coordinates, the viewer's included.
  double largest() const { return largest_; }
  /// The box of the vertices, widened by 2^-40 of the largest coordinate: 2^12 times what the
  /// coordinates are off.
  template <class Vertices>
  Box box_of(const Vertices& vertices) const {
    Box box;
    for (const VertexId vertex : vertices) box.add(points_[vertex]);
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] -= 0x1p-40 * largest_;
      box.high[k] += 0x1p-40 * largest_;
    }
    return box;
  }

 private:
  std::vector<Point> points_;
  Point viewer_{};
  bool directional_ = false;
  double largest_ = 1;
};

class SightShaft {
 public:
  /// Between the viewer and the segment; of one point if both are the same.
  SightShaft(const NearPositions& positions, VertexId a, VertexId b);

  bool misses(const Box& box) const { return is_beside(box) || is_off_plane(box); }

 private:
  /// Whether no part of the shaft has a box around it that meets this one. At a share s of the way
  /// the shaft's part is within s times the box of the edge as seen from the viewer; along a
  /// direction it is that box moved by s. Each axis bounds s from both sides.
  bool is_beside(const Box& box) const;
  /// Whether the box is on one side of the shaft's plane.
  bool is_off_plane(const Box& box) const;

  const NearPositions& positions_;
  Box edge_;  // from the viewer; along a direction: where it is
  std::array<double, 3> at_{}, normal_{};
  double plane_bound_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_SIGHT_SHAFT_H
