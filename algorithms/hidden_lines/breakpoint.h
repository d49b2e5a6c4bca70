// SPDX-License-Identifier: LGPL-3.0-or-later
// A place on an edge where the count changes, as a quotient of two determinants.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_BREAKPOINT_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_BREAKPOINT_H

#include <gmpxx.h>

#include <vector>

#include "algorithms/hidden_lines/both_sides.h"

namespace gnomon {

class Breakpoint {
 public:
  /// `at_start`, `at_end`: values of one linear function at the ends of the edge, which is zero at
  /// the breakpoint. Requires: of opposite signs, neither zero.
  Breakpoint(mpz_class at_start, mpz_class at_end, BothSides change);

  /// Negative, zero, positive: this is before, at, after the other. Exact; degree 6.
  int compare(const Breakpoint& other) const;
  mpq_class parameter() const;

  BothSides change;

 private:
  mpz_class before_, after_;  // distances from the ends in one unit, positive
  double near_ = 0;           // the parameter, off by less than kError
  static constexpr double kError = 0x1p-48;
};

/// In their order along the edge, those of one place as one with the sum of their changes, those
/// without a change dropped.
void sort_and_merge(std::vector<Breakpoint>& breakpoints);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_BREAKPOINT_H
