// SPDX-License-Identifier: LGPL-3.0-or-later
// Points of receivers, from which the light is looked at: exact points, and pairs of doubles whose
// differences to the scene's vertices have no cancellation.
//
// Everything in doubles is in units of 2^bits grid steps (bits of the scene's grid), so that all
// vertices of scene and lights lie in the unit cube.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_APEX_H
#define GNOMON_ALGORITHMS_ILLUMINATION_APEX_H

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "kernel/numbers/double_double.h"
#include "kernel/numbers/exact_integer.h"
#include "kernel/signs/ball.h"

namespace gnomon {

using ExactVector = Vector3<mpz_class>;
using BallVector = std::array<Ball, 3>;
using PairPoint = std::array<DoubleDouble, 3>;

inline BallVector cross(const BallVector& a, const BallVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Ball dot(const BallVector& a, const BallVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// Encloses a number that has a relative error of at most 4u, and what underflow adds.
inline Ball rounded_ball(double value) {
  return {value, 4 * Ball::kUnit * std::fabs(value) + Ball::kTiny};
}
/// The sign of the number, or kZero if the number may be 0.
inline Sign certain_sign(const Ball& ball) {
  return ball.middle > ball.radius    ? Sign::kPositive
         : ball.middle < -ball.radius ? Sign::kNegative
                                      : Sign::kZero;
}

/// numerator / denominator 2^-bits as a pair: error at most 2^-104 of it, plus 2^-1070.
DoubleDouble pair_of(const mpz_class& numerator, const mpz_class& denominator, unsigned bits);

/// a - b to within a relative error of 2u and an absolute one of 2^-100 `reach`. Requires: pairs
/// with errors of at most 2^-103 reach, |a|, |b| <= reach.
inline Ball difference_of(const DoubleDouble& a, const DoubleDouble& b, double reach) {
  const DoubleDouble high = two_sum(a.high, -b.high);
  const double middle = high.high + (high.low + (a.low - b.low));
  return {middle, 2 * Ball::kUnit * std::fabs(middle) + 0x1p-100 * reach};
}

/// A point on the grid as homogeneous integers, weight positive, and approximately.
struct Apex {
  ExactVector point;
  mpz_class weight;
  PairPoint near{};
  double reach = 1;  // 1, or more for points outside the unit cube: |coordinates| <= reach

  static Apex from(const Geometry& geometry, const std::array<mpq_class, 3>& scene_units);
  static Apex from(const Geometry& geometry, ExactVector point, mpz_class weight);
};

/// VertexPairs has all vertices of a scene as pairs of doubles.
class VertexPairs {
 public:
  explicit VertexPairs(const Geometry& geometry);
  const PairPoint& operator[](VertexId vertex) const { return points_[vertex]; }

 private:
  std::vector<PairPoint> points_;
};

inline BallVector difference_of(const PairPoint& a, const PairPoint& b, double reach) {
  return {difference_of(a[0], b[0], reach), difference_of(a[1], b[1], reach),
          difference_of(a[2], b[2], reach)};
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_APEX_H
