// SPDX-License-Identifier: LGPL-3.0-or-later
// The ladder of stages by which kernel `plane` decides every sign, in all of its spaces, and the
// count of which stage answered.
//
//  filter     doubles with a proven bound (filter_bounds.h) answer where the bound excludes the
//             other signs. They never answer "on".
//  identity   what the corner and the plane were made from answers "on" (plane_provenance.h).
//  narrow     64-bit integers,
//  fixed      128 to 1024 bits,
//  wide       GMP's integers: whichever is the narrowest that holds every intermediate, by the bits
//             of the precision plan. The answer is exact, so that the ladder ends here.
//
// The filter answers only what is not zero and identity only what is: their order is free for the
// answers and the counts, and the filter comes first because it costs least and answers most.
#ifndef GNOMON_KERNEL_IMPLICIT_STAGED_SIGN_H
#define GNOMON_KERNEL_IMPLICIT_STAGED_SIGN_H

#include <cmath>

#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/numbers/exact_integer.h"

namespace gnomon {

template <class Stats>
class StagedSign {
 public:
  /// The first stage. `value` is the plane's value in doubles, off by at most `error_bound`; the
  /// side is of the plane, or of its opposite if `flipped`. Else the answer is that of undecided().
  template <class Undecided>
  Side filtered(double value, double error_bound, bool flipped, const Undecided& undecided) {
    if (std::fabs(value) > error_bound) {
      stats_.count(Stage::kFilter);
      // Without a branch, which would be mispredicted half of the time.
      return static_cast<Side>(2 * int{(value > 0) != flipped} - 1);
    }
    return undecided();
  }
  /// The second stage: the answer is known without arithmetic.
  Sign known(Sign sign) {
    stats_.count(Stage::kIdentity);
    return sign;
  }
  Side known_on() { return side_of(known(Sign::kZero)); }
  /// The last stage: the sign of predicate.operator()<Factor, Int>(), Int the integers of `width`,
  /// Factor the narrowest for vectors of `factor_bits` (with_widths()).
  template <class Predicate>
  Sign exact(IntegerWidth width, unsigned factor_bits, const Predicate& predicate) {
    stats_.count(exact_stage(width));
    const Sign sign = with_widths(width, factor_bits, predicate);
    if (sign == Sign::kZero) stats_.count_zero();
    return sign;
  }

  StageCounts counts() const { return stats_.counts(); }

 private:
  [[no_unique_address]] Stats stats_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_STAGED_SIGN_H
