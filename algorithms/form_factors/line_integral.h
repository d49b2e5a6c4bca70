// SPDX-License-Identifier: LGPL-3.0-or-later
// The double contour integral of two polygons that see each other: area times form factor is
// 1 / (2 pi) of the sum over all pairs of edges of (e . f) times the integral of ln r along both.
// The inner integral is elementary; the outer is by Gauss and Legendre with a proven bound of its
// error (docs: form-factors).
#ifndef GNOMON_ALGORITHMS_FORM_FACTORS_LINE_INTEGRAL_H
#define GNOMON_ALGORITHMS_FORM_FACTORS_LINE_INTEGRAL_H

#include <span>

#include "algorithms/form_factors/vectors.h"

namespace gnomon {

/// A value, and how far it may be off.
struct Bounded {
  double value = 0, error = 0;
};

/// The area of `from` times its form factor to `to`. Requires: convex loops, each in front of the
/// other's plane or on it, in a scene of extent 1.
Bounded exchange_area(std::span<const Vector> from, std::span<const Vector> to);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FORM_FACTORS_LINE_INTEGRAL_H
