// SPDX-License-Identifier: LGPL-3.0-or-later
// The plane through a light and each edge, for values at vertices that are much less off than those
// of lines at rays: where only a value's sign is asked for, lines are enough.
//
// Of an edge from a to b the plane's normal n is r_a x (b - a), of a sun d x (b - a), and its value
// at a vertex n . (v - a), from exact differences of rays or positions. That is the line's value at
// the vertex's ray, det(r_a, r_b, r_v); of a sun less the factor ExactValues::unit(), since nothing
// of d is multiplied in twice. What cancels in n . r_v, where a ray is long and v is near a, is
// left out, and errors count by the terms that there are, which are few in scenes along the axes.
#ifndef GNOMON_ALGORITHMS_CONTOUR_EDGE_PLANES_H
#define GNOMON_ALGORITHMS_CONTOUR_EDGE_PLANES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "algorithms/contour/contour_bounds.h"
#include "algorithms/contour/numbers.h"
#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/orientation.h"

namespace gnomon {

class EdgePlanes {
 public:
  struct Plane {
    Vector<double> normal;
    Vector<float> size;  // of the two products of each component of the normal, rounded up
    VertexId at;         // the edge's a
  };

  bool empty() const { return planes_.empty(); }
  void clear() { planes_.clear(); }
  const Plane& of(EdgeId edge) const { return planes_[edge]; }

  /// Differences are those of exact doubles, by VertexId, which outlive this.
  void start(std::size_t edges, const std::vector<Vector<double>>& points);
  /// Differences are those of a narrow grid, times `scale`, along the axes.
  void start(std::size_t edges, const GridPositions& grid, const std::array<int, 3>& axes,
             double scale);
  /// `terms`: what a value is off by in units of its terms (ContourBounds::kPlane or less); values
  /// of terms below `exact` are exact.
  void set_bounds(double terms, double exact) {
    terms_ = terms;
    exact_ = exact;
  }
  /// The plane of an edge with its ends a and b, from the apex of its normal.
  void set(EdgeId edge, const EdgeEnds& ends, const Vector<double>& apex) {
    const Vector<double> step = difference(ends.b, ends.a);
    planes_[edge] = {cross_product(apex, step), sizes_of_cross(apex, step), ends.a};
  }

  /// The value at a vertex, and the size of its terms.
  [[gnu::always_inline]] double value(const Plane& plane, VertexId v, double& size) const {
    const Vector<double> step = difference(v, plane.at);
    size = plane.size[0] * std::fabs(step[0]) + plane.size[1] * std::fabs(step[1]) +
           plane.size[2] * std::fabs(step[2]);
    return dot_product(plane.normal, step);
  }
  /// What a value of such terms is off by.
  double error(double size) const { return size < exact_ ? 0 : terms_ * size; }
  /// The value of an edge in a polygon's direction at a vertex, and what that is off by.
  double value(PlaneRef edge, VertexId v, double& off_by) const {
    double size;
    const double result = value(planes_[edge.index()], v, size);
    off_by = error(size);
    return edge.flipped() ? -result : result;
  }

 private:
  /// Off by u of each component; exact of exact points whose differences are doubles.
  [[gnu::always_inline]] Vector<double> difference(VertexId v, VertexId from) const {
    if (points_ != nullptr) {
      const Vector<double>&p = points_[v], &q = points_[from];
      return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    }
    const std::int64_t *p = grid_->narrow_point(v), *q = grid_->narrow_point(from);
    const auto along = [&](int axis) { return static_cast<double>(p[axis] - q[axis]) * scale_; };
    return {along(axes_[0]), along(axes_[1]), along(axes_[2])};
  }
  static Vector<float> sizes_of_cross(const Vector<double>& a, const Vector<double>& b) {
    constexpr double kUp = 1 + 0x1p-22;
    constexpr double kLeast = std::numeric_limits<float>::min();  // below it floats lose bits
    const auto size = [&](int i, int j) {
      const double terms = std::fabs(a[i] * b[j]) + std::fabs(a[j] * b[i]);
      return static_cast<float>(terms == 0 ? 0 : std::max(kLeast, kUp * terms));
    };
    return {size(1, 2), size(2, 0), size(0, 1)};
  }

  std::vector<Plane> planes_;  // by EdgeId
  const Vector<double>* points_ = nullptr;
  const GridPositions* grid_ = nullptr;  // where there are no points
  std::array<int, 3> axes_{0, 1, 2};
  double scale_ = 1, terms_ = 0, exact_ = 0;
};

inline void EdgePlanes::start(std::size_t edges, const std::vector<Vector<double>>& points) {
  planes_.resize(edges);
  points_ = points.data();
}

inline void EdgePlanes::start(std::size_t edges, const GridPositions& grid,
                              const std::array<int, 3>& axes, double scale) {
  planes_.resize(edges);
  points_ = nullptr;
  grid_ = &grid;
  axes_ = axes;
  scale_ = scale;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_EDGE_PLANES_H
