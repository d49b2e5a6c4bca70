// SPDX-License-Identifier: LGPL-3.0-or-later
// The contour integral of diffuse illumination, 1/2 sum alpha cos(beta) over the edges of the
// visible pieces of a light: in doubles with bounds, and by MPFR from exact coordinates. Formulas
// and proofs: docs/illumination.md.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_CONTOUR_INTEGRAL_H
#define GNOMON_ALGORITHMS_ILLUMINATION_CONTOUR_INTEGRAL_H

#include "algorithms/illumination/visible_pieces.h"
#include "kernel/signs/ball.h"

namespace gnomon {

/// Encloses the square root of a number that is not negative.
Ball square_root(const Ball& x);
/// arctan(t) / t for t in [0, 1], 1 at 0: relative error at most kArcTangentError.
double arc_tangent_over(double t);
inline constexpr double kArcTangentError = 12 * Ball::kUnit;
/// Encloses angle / sine, where the angle (0 to pi) has sine and cosine in the ratio of s (not
/// negative) and c, and `sine` is s itself: angle / s. Infinite radius where that may have a pole.
Ball angle_over(const Ball& s, const Ball& c);

/// Encloses 1/2 sum alpha cos(beta).
Ball contour_integral(LightPieces& pieces, const LightView& view, const Part& part, Side side,
                      std::uint32_t apex);

/// The same at growing precision until the relative error is met. `bits`: the precision that it
/// took. Requires: some piece. A value below the range of doubles has an absolute error of 2^-1074.
Ball contour_integral_mpfr(LightPieces& pieces, const LightView& view, const Part& part, Side side,
                           std::uint32_t apex, double relative_error, std::uint64_t& bits);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_CONTOUR_INTEGRAL_H
