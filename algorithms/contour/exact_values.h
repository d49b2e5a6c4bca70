// SPDX-License-Identifier: LGPL-3.0-or-later
// Values of lines and planes at input vertices from a light's integers, rounded once: for the few
// whose doubles are too far off, so that a share is known to the last digits that are printed.
//
// Exactness: each is off by at most the stated multiple of itself, whatever cancels in it, where
// nothing underflows. Tests: tests/algorithms/contour_bounds_test.cc.
#ifndef GNOMON_ALGORITHMS_CONTOUR_EXACT_VALUES_H
#define GNOMON_ALGORITHMS_CONTOUR_EXACT_VALUES_H

#include <optional>

#include "gnomon/kernel/geometry.h"
#include "kernel/implicit/light_integers.h"
#include "kernel/numbers/double_double.h"
#include "kernel/signs/ball.h"

namespace gnomon {

class ExactValues {
 public:
  /// An integer's conversion.
  static constexpr double kLine = 2.1 * Ball::kUnit;
  /// The square of a sun's d_z, which is off by 2u.
  static constexpr double kUnit = 5.1 * Ball::kUnit;
  /// Two conversions of 2u and a quotient.
  static constexpr double kDepth = 5.1 * Ball::kUnit;
  static constexpr double kSupport = 2.1 * Ball::kUnit;
  /// Two conversions of 2^-104 and a quotient of 2^-101.
  static constexpr double kCrossing = 0x1.4p-101;

  /// `ray_bits`: the bits s by which rays r = 2^-s q are scaled.
  ExactValues(const LightIntegers& light, unsigned ray_bits);

  /// The line from a to b at v, det(r_a, r_b, r_v), for a sun less the factor unit(); off by kLine.
  double line(VertexId a, VertexId b, VertexId v) const;
  EdgeEnds ends(EdgeId edge) const { return light_.geometry->edges[edge]; }
  /// What sun's lines have besides, which is no matter for places: off by kUnit. Of a lamp 1.
  double unit() const { return unit_; }
  /// The depth of a plane at a vertex; off by kDepth. Requires: a lamp that is not in the plane.
  double depth(PlaneId plane, VertexId v) const;
  /// Where the edge of a polygon from one vertex to another crosses the line from a to b, or a
  /// support plane: t of from + t (to - from), off by kCrossing; nothing if both are on one side.
  std::optional<DoubleDouble> crossing(VertexId a, VertexId b, VertexId from, VertexId to) const;
  std::optional<DoubleDouble> crossing(PlaneId plane, VertexId from, VertexId to) const;
  /// How far a vertex is above a plane, in units of that plane; off by kSupport.
  double support(PlaneId plane, VertexId v) const;

 private:
  /// The line from a to b at other vertices, in integers that hold it.
  template <class Int>
  auto line_of(VertexId a, VertexId b) const;

  LightIntegers light_;
  long shift_;  // of a line's integer
  double unit_ = 1;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_EXACT_VALUES_H
