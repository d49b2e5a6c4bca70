// SPDX-License-Identifier: LGPL-3.0-or-later
// The proven error bounds of the filters of kernel `plane`: every constant beside its derivation.
//
// u = 2^-53 is the unit roundoff. A sum or product rounds by at most u times its result, and an
// integer that is converted once is off by at most 2u of itself (GMP truncates). Planes and
// vertices are scaled by powers of two to size 1, so that bounds are absolute multiples of u, which
// nothing that underflows comes near. First-order terms are counted below; where a constant is
// larger than the count, the rest is slack for terms of second order.
// tests/kernel/filter_bound_test.cc computes every first-order count again, by following the
// formula term by term, and holds computed values against rational ones.
//
// Reference: docs/exactness.md; Broennimann, Burnikel and Pion, Interval arithmetic yields
// efficient dynamic filters, 2001.
#ifndef GNOMON_KERNEL_IMPLICIT_FILTER_BOUNDS_H
#define GNOMON_KERNEL_IMPLICIT_FILTER_BOUNDS_H

#include <limits>

#include "kernel/signs/ball.h"

namespace gnomon {

/// The bound of doubles that say nothing.
inline constexpr double kUnknownError = std::numeric_limits<double>::infinity();

/// A float that is not smaller. Rounding to float errs by 2^-24 of the bound.
constexpr float rounded_up(double bound) { return static_cast<float>(bound * (1 + 0x1p-22)); }

/// Decisions about support planes in space: n . x - d with |n_k| < 1, |x_k| <= 1, |d| < 3.
struct SceneBounds {
  static constexpr double kUnit = Ball::kUnit;
  /// Of a coordinate that is converted once.
  static constexpr double kInputError = 2 * kUnit;
  /// Of n . x - d: 3 * 2u from n, 6u from d (2u of 3), and roundings of three products (3u), of
  /// sums of two and three of them (2u + 3u) and of the difference (6u): 26u.
  static constexpr double kPlaneError = 64 * kUnit;
  /// The same for a vertex whose coordinates are off by `vertex_error`: 3 times that, besides.
  static constexpr double value(double vertex_error) { return 3.01 * vertex_error + kPlaneError; }

  /// Where an edge meets a plane: the parameter t = f / (f - g), with values f, g at the ends, each
  /// off by v. If the gap |f - g| is more than kLeastGap v, then the true gap is at least 3/4 of
  /// the gap, and |f| + |g| at most 5/4 of it, so that t is off by at most 5/4 v / (3/4 gap) =
  /// 1.67 v / gap; the difference and the quotient round by 2u.
  static constexpr double kLeastGap = 8;
  static constexpr double parameter(double value_error, double gap) {
    return 2.7 * value_error / gap + 4 * kUnit;
  }
  /// The point u + t (v - u) of ends that are off by `end_error`, with |v - u| <= span: the ends'
  /// own error, (span + 2 end_error) times that of t, and three roundings of at most 2u.
  static constexpr double crossing(double end_error, double span, double parameter_error) {
    return (end_error + (span + 2 * end_error) * parameter_error) * 1.01 + 8 * kUnit;
  }
};

/// Decisions in light space: n . r with |n_k| <= 1 and |r_k| <= m. A plane carries its slack f >=
/// 1, the error of its components in units of 2u; a ray carries the rest of the bound.
struct LightBounds {
  static constexpr double kUnit = Ball::kUnit;
  /// Of n . r for r off by `error`: 3 error + 3 * 2u f (m + error) from the operands, and roundings
  /// of three products (3u m) and of sums of two and three of them (2u m + 3u m), 8u m. That is at
  /// most f times what this function gives, for 1 <= f <= kMostSlack.
  static constexpr double ray(double error, double magnitude) {
    return 3.01 * error + 14.1 * kUnit * magnitude;
  }
  static constexpr double kMostSlack = 0x1p40;
  /// Of a ray of an input vertex: largest component in [1/2, 1), each converted once.
  static constexpr float input() { return rounded_up(ray(2 * kUnit, 1)); }
  /// A made ray m x n. A component is two products of factors below 1 that are off by 2u times
  /// their slack: 2 (2u f_m + 2u f_n) from the operands, and roundings of two products and a
  /// difference, u + u + 2u. So it is off by kMadeError (f_m + f_n + 1), and below kMadeMagnitude.
  static constexpr double kMadeError = 4.01 * kUnit;
  static constexpr double kMadeMagnitude = 2;
  static constexpr float made(double slack_m, double slack_n) {
    constexpr double kSlack = ray(kMadeError, 0);
    constexpr double kRest = ray(kMadeError, kMadeMagnitude);
    return rounded_up(kSlack * (slack_m + slack_n) + kRest);
  }
  /// Of a ray's component, from its bound: ray() is at least three times that, and more by the
  /// rest.
  static constexpr double component(double bound, double magnitude) {
    return (bound - ray(0, magnitude)) * (1 / 3.0);
  }

  /// Of a component of a depth plane n / h, relative: two conversions and a quotient, 2u + 2u + u.
  static constexpr double kDepthPlane = 8 * kUnit;
  /// Of depth . r, relative to the depth plane's largest component: 3 error and 3 * 8u (m + error)
  /// from the operands, 8u m from roundings: 32u m.
  static constexpr double depth(double magnitude_of_depth, double error, double magnitude) {
    return magnitude_of_depth * (3.01 * error + 33 * kUnit * magnitude);
  }
  /// Of (depth - depth') . r with |r_k| <= 2, relative to the sum M of the two largest components.
  /// A difference is off by 8u M from its operands and u M from its rounding, kDepthDifference M.
  /// With r off by e <= bound / 3: 3 M e, which is at most M bound; 3 * 9.1u * 2 M from the
  /// differences; roundings of 16u M (as above, m = 2). 70.6u M.
  static constexpr double kDepthDifference = 9.1 * kUnit;
  static constexpr double depth_difference(double sum, double bound) {
    return sum * (bound + 72 * kUnit);
  }
  /// The slack of a cut of two supports: its normal is that difference, scaled to size 1 by
  /// `scale`, in units of 2u.
  static constexpr double cut_slack(double sum, double scale) { return 1 + 4.6 * sum * scale; }
  /// A difference that cancels more than this says nothing.
  static constexpr double kLeastDifference = 0x1p-40;

  /// Quotients of rays are bounded while the divisor's relative error is below this; 1.01 then
  /// covers the terms of second order.
  static constexpr double kMostRelative = 0x1p-10;
  /// Roundings of a quotient: a reciprocal, a product, and a sum or a sign.
  static constexpr double kQuotient = 3 * kUnit;
  /// Of h r / (n . r), each factor converted once from integers (2u), three operations: 9u.
  static constexpr double kAccurate = 16 * kUnit;
  /// The same in pairs of doubles: three conversions (2^-104 each), a quotient (2^-101) and a
  /// product (2^-102).
  static constexpr double kAccuratePair = 0x1p-99;
};

/// Decisions of shadow volumes: n . x - d with the largest |n_k| in [1/2, 1) and |d| < 3.
struct VolumeBounds {
  static constexpr double kUnit = Ball::kUnit;
  /// Of the offset d = n . a in doubles: factors off by 2u each (12u), three products (3u), and
  /// sums of two and three of them (2u + 3u).
  static constexpr double kOffset = 20 * kUnit;
  /// Of n . x - d for a vertex that is exactly its doubles, |x_k| <= M, M >= 1: 6u M from n,
  /// kOffset, and roundings of 3u M (products), 5u M (sums) and 6u M (difference). 40u M.
  static constexpr double kPlaneError = 48 * kUnit;
  /// The same for x off by `error` in each coordinate: 3 times that, besides.
  static constexpr double vertex(double error, double magnitude) {
    return 3.01 * error + kPlaneError * magnitude;
  }
  /// Of a coordinate, from its vertex's bound, which is 3.01 times that and at least kPlaneError.
  static constexpr double coordinate(double bound) { return (bound - kPlaneError) / 3; }
  /// An input coordinate is exact while it fits a double.
  static constexpr unsigned kExactBits = 53;
  static constexpr double input(unsigned bits) { return bits <= kExactBits ? 0 : 2 * kUnit; }

  /// A vertex on an input edge, from the edge's ends: as in space, but with 1.7 v / gap for the
  /// parameter, 4u for its roundings, ends off by 2u, and three roundings.
  static constexpr double kLeastGap = 8;
  static constexpr double edge_point(double value_error, double gap, double span) {
    return 1.01 * (span + 4 * kUnit) * (1.7 * value_error / gap + 4 * kUnit) + 8 * kUnit;
  }
  /// A vertex of three planes as x + (r_0 n_1 x n_2 + r_1 n_2 x n_0 + r_2 n_0 x n_1) / det, from
  /// any point x of size M, with residuals r_i = d_i - n_i . x. Residuals are off by kPlaneError M;
  /// components of cross products by 2 * (2u + 2u + u) + 2u = 12u, kCross; the determinant by
  /// 3 * 2 * 2u + 3 * kCross and roundings of 16u, 65u, kDeterminant. With C the largest sum over i
  /// of a component of the cross products, R the sum of |r_i| and a step of s: residuals give
  /// kPlaneError M C, cross products 12.2u R, products and sums 6u R more (19u R in all, with
  /// slack), and the determinant 67u s. The reciprocal, the product and the sum round by 4u (M +
  /// s).
  static constexpr double kCross = 12.2 * kUnit;
  static constexpr double kDeterminant = 66 * kUnit;
  static constexpr double meet(double magnitude, double most, double residuals, double moved,
                               double determinant) {
    return 1.01 * (kPlaneError * magnitude * most + 19 * kUnit * residuals + 67 * kUnit * moved) /
               determinant +
           4 * kUnit * (magnitude + moved);
  }
  /// With a smaller determinant of normals that bound is not tried.
  static constexpr double kLeastMeet = 0x1p-30;
  /// A choice, not a bound: doubles of a made vertex that are off by more than this are computed
  /// again from the integers.
  static constexpr double kWorstError = 0x1p-40;
  /// Of a vertex from the integers: x / w is off by 5u of itself (two conversions, a quotient), the
  /// origin by 2u, and the sum by u: 8u where both are at most 1.
  static constexpr double repaired(double magnitude) {
    return vertex(16 * kUnit * magnitude, 1.01 * magnitude);
  }

  /// The sign of n . (q - p) x (r - p) in doubles, with coordinates off by at most e in all: 2 e +
  /// u for a difference, 4 times that and 4u for a component of the cross product, 3 times that and
  /// 28u for the product, 24 e + 52u.
  static constexpr double turn(double error) { return 64 * (error + kUnit); }

  /// Offsets of a point from a vertex o, relative to what they are. Values of planes at o come from
  /// the integers, off by 2u: with cross products off by kCross and at most 2, v_0 c_0 + v_1 c_1 +
  /// v_2 c_2 is off by 12.2u + 2 * 2u + 8u = 24.2u of the sum of |v_i|, and the determinant by
  /// kDeterminant.
  static constexpr double offset(double sum, double magnitude, double determinant) {
    return 1.01 * kUnit * (25 * sum + 67 * magnitude) / determinant + 4 * kUnit * magnitude +
           Ball::kTiny;
  }
  /// With a smaller determinant of normals, offsets come from the integers: a choice.
  static constexpr double kLeastDeterminant = 0x1p-6;
  /// The parameter of an edge from two values of different signs, off by 2u each: 2 * 2u and two
  /// roundings, 6u. Not where a value may have underflowed.
  static constexpr double kParameter = 6.1 * kUnit;
  /// A quotient of two integers, converted once each: 5u.
  static constexpr double kQuotient = 5.1 * kUnit;
};

/// Nearest doubles, in pairs of doubles (double_double.h): every factor is off by less than 2^-100
/// of itself, and a coordinate is a sum of fewer than 2^6 terms, so by 2^-94 of their magnitudes.
inline constexpr double kPairError = 0x1p-94;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_FILTER_BOUNDS_H
