// SPDX-License-Identifier: LGPL-3.0-or-later
// The coordinates of an angular table: directions from a light in the frame of a picture (Thakur,
// Cheng & Miura, section 3.1). Of a point x three linear functions are taken: alpha across, beta
// upwards, gamma ahead; s = alpha / gamma and t = beta / gamma are the tangents of the paper's phi
// and theta, rational numbers. A row, t constant, is a plane through the light and along the
// picture's rows.
//
// Of a sun gamma is 1, and alpha and beta go across its rays. Loops that are counter-clockwise as
// the light sees them are so in (s, t). Exact: all functions have integer coefficients on the grid.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_CHART_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_CHART_H

#include <gmpxx.h>

#include <array>
#include <vector>

#include "algorithms/ridge_edges/light_directions.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/kernel/image_frame.h"
#include "kernel/concept/image_space.h"

namespace gnomon {

struct TableChart {
  /// A border of a pyramid of directions.
  enum Border : std::uint8_t { kRight, kLeft, kTop, kBottom };
  static constexpr std::size_t kBorders = 4;

  GridPlane across, upwards, ahead;  // alpha, beta and gamma as functions n . x - d
  /// It holds the pyramid |s| <= 1, |t| <= 1 alone, and everything is clipped by its borders.
  bool is_pyramid = false;
  /// gamma is 1 everywhere: of a sun.
  bool is_flat = false;

  /// (alpha, beta, gamma) of a point of the grid.
  DirectionVector of(const DirectionVector& point) const;
  /// Where t is more than this in front, for what is ahead of the light.
  GridPlane row(const mpq_class& t) const;
  /// Where s is more than this.
  GridPlane column(const mpq_class& s) const;
  /// A border of the pyramid, its inside in front.
  GridPlane border(Border border) const;
  /// The value of that border at (alpha, beta, gamma): positive inside.
  static mpz_class inside(Border border, const DirectionVector& direction);
};

/// The charts of a light that together hold what a table of this hemisphere is asked for: one, or
/// six pyramids around a lamp.
std::vector<TableChart> charts_of(const ImageFrame& frame, const LightPoint& light,
                                  Hemisphere hemisphere);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_CHART_H
