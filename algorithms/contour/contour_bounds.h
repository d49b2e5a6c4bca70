// SPDX-License-Identifier: LGPL-3.0-or-later
// The bounds of the contour method's certified numbers, each with its count of first order.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_BOUNDS_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_BOUNDS_H

#include "kernel/signs/ball.h"

namespace gnomon {

/// The bounds of the certified numbers, u = 2^-53. Tests: tests/algorithms/contour_bounds_test.cc.
struct ContourBounds {
  static constexpr double kUnit = Ball::kUnit;
  /// Of a ray's component and of a difference of rays, relative: integers, converted once (GMP
  /// truncates).
  static constexpr double kRay = 2 * kUnit;
  /// Of n . r for n = a x d with |a_k| <= A, |d_k| <= D, |r_k| <= R, in units of A D R. A product
  /// a_k d_l is off by 2u + 2u from its factors and u from rounding, two of them by 10u A D, and
  /// their difference rounds by 2u A D: a component of n, at most 2 A D, is off by 12u A D. Three
  /// of them: 36u; r: 3 * 2 * 2u = 12u; roundings of three products 6u and of sums of two and three
  /// of them 4u + 6u. 64u, and slack for terms of second order.
  static constexpr double kLine = 66 * kUnit;
  /// Of depth . r with components of depth off by 8u M (LightBounds::kDepthPlane), |r_k| <= R, in
  /// units of M R: 3 (8u + 2u) from the operands, roundings 3u + 2u + 3u. 38u.
  static constexpr double kDepth = 40 * kUnit;
  /// The same where normals and rays are doubles: depth is off by 2u of itself (the conversion of a
  /// height, and a quotient), 6u M R, and roundings are 8u M R. 14u, and 3u for what is done with
  /// it (depths are subtracted, or their planes); where a bound of 1.1 times this is asked for,
  /// that is within it.
  static constexpr double kDepthOfExact = 18 * kUnit;
  /// c = d x s from differences of at most D and S that are exact: a component is off by 2u D S
  /// from its products and 2u D S from their difference. Nothing, if 2 D S is below 2^53 of their
  /// units.
  static constexpr double kCross = 4.1 * kUnit;
  /// apex . c in units of the sum of |apex_k c_k|: a product and sums of two and three of them, 3u;
  /// a sun's direction is off by 2u. Of a lamp nothing, if 6 A D S is below 2^53.
  static constexpr double kApex = 3.1 * kUnit, kSunApex = 5.1 * kUnit;
  /// What a value from sharp_value() may be off by, relative, for integrals, and where all of it
  /// may be a sliver.
  static constexpr double kSharp = 32 * kUnit, kSharpest = 8 * kUnit;

  /// A sun's rays from doubles, where positions are exactly doubles: r = (x d_z - z d_x, y d_z - z
  /// d_y, d_z) with |x_k| <= 1 exact and |d_k| <= 1 converted once, so that |r_k| <= kSunReach. A
  /// product is off by 2u + u, two of them by 6u, and their difference rounds by 2u: 8u; r_z 2u.
  static constexpr double kSunReach = 2;
  /// Of n . r for n = a x d with d the same from differences of at most D, rounded once: a product
  /// of those is off by 4u D, and d by 8u D + 2u D, |d_k| <= 2 D, d_z = 0. n_x = -a_z d_y is off by
  /// 10u D
  /// + 2 * 2u D + 2u D = 16u D, n_y alike; n_z, of size 8 D, by two of 2 * 10u D + 2 * 8u D + 4u D
  /// and 8u D: 88u D. n_x r_x: 2 * 16u D + 2 * 8u D + 4u D = 52u D, n_y r_y alike; n_z r_z: 88u D +
  /// 8 * 2u D + 8u D = 112u D; sums of two and three of them round by 8u D + 16u D. 240u D, which
  /// is this times D and kSunReach.
  static constexpr double kSunLine = 128 * kUnit;
  /// A far lamp's rays have r_z = d_z - t z, and lines d_z = -t (b_z - a_z), t <= 2^-12: r_z is off
  /// by 3u, so that n_x and n_y are off by 2u D more, and n_x r_x and n_y r_y by 4u D each; n_z r_z
  /// by 8u D. 256u D, and what is multiplied by t.
  static constexpr double kFarLine = 132 * kUnit;
  /// Of depth . r likewise: 2 (2 * 8u + 8u + 2u) M + (8u + 2u + u) M + 9u M = 72u M, in units of M
  /// and kSunReach: within kDepth.

  /// Of n . s for n = apex x step, the apex off by 2u and differences of exact positions by u, in
  /// units of the sum of m_k |s_k| with m_k that of the two products of n_k, without sign: each of
  /// those is off by 2u + u of itself and rounds by u, their difference by u m_k: 5u. s_k, the
  /// product and sums of two and three: u + u + 2u. 9u.
  static constexpr double kPlane = 9.2 * kUnit;
  /// The same where differences and the apex are exact: u + u, u, and 2u. Nothing is rounded, if
  /// the sum is below 2^53 of their units.
  static constexpr double kPlaneOfExact = 5.1 * kUnit;
  /// The same of a far lamp, whose apex is off by 3.1u: 10.1u.
  static constexpr double kFarPlane = 10.4 * kUnit;
  /// apex . c of a far lamp in units of the sum of A_k |c_k|, A_k = |d_k| + t: d_k is off by 2u and
  /// the difference d_k - t a_k by u A_k, its product and sums by 3u.
  static constexpr double kFarApex = 6.2 * kUnit;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_BOUNDS_H
