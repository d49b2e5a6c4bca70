// SPDX-License-Identifier: LGPL-3.0-or-later
// The precision plan of pictures: signed bits of the exact predicates at samples, for a grid of b
// bits, directions to lights of e bits, and directions of samples of p signed bits
// (ImageFrame::direction_bits()), whose components are then below 2^(p-1).
//
// Every bound holds for all intermediates. With D = 2^b - 1 and E = 2^e - 1 a normal through three
// positions is at most D^2 (twice the area of a triangle), its value at the eye 2 D^3, a normal
// along a direction 2 D E, and its value 3 D^2 E. Derivations: docs/image-space.md.
#ifndef GNOMON_KERNEL_IMAGE_PRECISION_H
#define GNOMON_KERNEL_IMAGE_PRECISION_H

#include <algorithm>

namespace gnomon {

/// n . d of a plane through the eye and two positions: three products of D^2 2^(p-1).
constexpr unsigned image_coverage_bits(unsigned b, unsigned p) { return 2 * b + p + 2; }
/// The same of a plane through the eye, a position and a direction: 3 * 2 D E 2^(p-1).
constexpr unsigned image_coverage_bits(unsigned b, unsigned e, unsigned p) { return b + e + p + 3; }
/// (n . d) Q(E) - (m . d) P(E) for a support plane P = (n, .) and any plane Q = (m, .) through
/// three positions: two products of 3 D^2 2^(p-1) and 2 D^3, 12 D^5 2^(p-1).
constexpr unsigned image_side_bits(unsigned b, unsigned p) { return 5 * b + p + 4; }
/// The same where Q is along a direction: 9 D^4 E 2^(p-1) and 12 D^4 E 2^(p-1).
constexpr unsigned image_side_bits(unsigned b, unsigned e, unsigned p) { return 4 * b + e + p + 5; }
/// The same where both are along directions: 3 * 2 D E 2^(p-1) times 3 * 2 D^2 E, twice.
constexpr unsigned image_order_bits(unsigned b, unsigned e, unsigned p) {
  return 3 * b + 2 * e + p + 7;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMAGE_PRECISION_H
