// SPDX-License-Identifier: LGPL-3.0-or-later
// Where along a row of samples a sign changes, in doubles: what every image space has for its
// guesses. Nothing depends on them but time.
#ifndef GNOMON_KERNEL_CONCEPT_IMAGE_GUESS_H
#define GNOMON_KERNEL_CONCEPT_IMAGE_GUESS_H

#include <array>
#include <cstdint>

#include "gnomon/kernel/image_frame.h"

namespace gnomon {

/// A plane as a guess needs it: its normal and its value at the eye, up to one positive factor.
struct GuessedPlane {
  std::array<double, 3> n{};
  double at_eye = 0;

  double along(const ImageFrame::Direction& d) const {
    return n[0] * static_cast<double>(d[0]) + n[1] * static_cast<double>(d[1]) +
           n[2] * static_cast<double>(d[2]);
  }
  double along(const std::array<std::int32_t, 3>& d) const {
    return n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
  }
};

/// The column at which a linear function of it is zero, from its value in column 0 and its slope.
inline double zero_of_row(double first, double slope) { return -first / slope; }

inline double guess_covers(const ImageFrame& frame, const GuessedPlane& plane, std::uint32_t row) {
  return zero_of_row(plane.along(frame.direction({0, row})),
                     2.0 * frame.height * plane.along(frame.right));
}

inline double guess_side(const ImageFrame& frame, const GuessedPlane& q, const GuessedPlane& p,
                         std::uint32_t row) {
  const ImageFrame::Direction first = frame.direction({0, row});
  return zero_of_row(
      p.along(first) * q.at_eye - q.along(first) * p.at_eye,
      2.0 * frame.height * (p.along(frame.right) * q.at_eye - q.along(frame.right) * p.at_eye));
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_IMAGE_GUESS_H
