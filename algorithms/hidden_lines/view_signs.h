// SPDX-License-Identifier: LGPL-3.0-or-later
// The two determinants that hidden lines are decided by, as seen from an eye or a light.
//
// Exactness: signs by doubles with a bound, and where these do not decide by integers of 128 bits
// where the grid lets them fit, else by GMP.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_VIEW_SIGNS_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_VIEW_SIGNS_H

#include <gmpxx.h>

#include <array>
#include <cstdint>

#include "gnomon/kernel/geometry.h"

namespace gnomon {

class ViewSigns {
 public:
  /// Keeps a reference to the geometry.
  ViewSigns(const Geometry& geometry, const LightPoint& viewer);

  /// The sign of [p, q, r] = det(p - E, q - E, r - E); of -d . ((q - p) x (r - p)) for a direction
  /// d to the light.
  ///  1. Negative: seen from the viewer, r is on the left of the line from p to q, or p, q, r run
  ///     counter-clockwise. Zero: the plane of the three holds the viewer.
  ///  2. It changes its sign with every exchange of two.
  /// Exactness: exact. Degree: 3 in positions; 2 and 1 in the direction. Bits: 3b + 2, the viewer
  /// on the grid.
  int bracket(VertexId p, VertexId q, VertexId r) const;
  mpz_class exact_bracket(VertexId p, VertexId q, VertexId r) const;

  /// The sign of det(b - a, c - a, d - a): positive if d is in front of a, b, c.
  /// Exactness: exact. Degree: 3. Bits: 3b + 2.
  int volume(VertexId a, VertexId b, VertexId c, VertexId d) const;
  mpz_class exact_volume(VertexId a, VertexId b, VertexId c, VertexId d) const;

  /// Whether the three are on one line. Exact.
  bool are_collinear(VertexId a, VertexId b, VertexId c) const;
  /// Whether the line through the two holds the viewer. Exact.
  bool is_towards_viewer(VertexId a, VertexId b) const;

  bool directional() const { return directional_; }

 private:
  using Narrow = std::array<std::int64_t, 3>;
  using Wide = std::array<mpz_class, 3>;

  Narrow narrow_difference(VertexId from, VertexId to) const;
  Narrow narrow_view(VertexId vertex) const;  // from the viewer to the vertex
  Wide wide_difference(VertexId from, VertexId to) const;
  Wide wide_view(VertexId vertex) const;
  int sign(const Narrow& a, const Narrow& b, const Narrow& c) const;

  const GridPositions& grid_;
  bool directional_ = false;
  Wide viewer_;
  // Of the viewer, if all differences fit into 64 bits.
  bool is_narrow_ = false;
  Narrow narrow_viewer_{};
  bool fits_128_ = false;  // every determinant
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_VIEW_SIGNS_H
