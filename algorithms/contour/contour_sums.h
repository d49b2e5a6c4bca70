// SPDX-License-Identifier: LGPL-3.0-or-later
// What is known of each polygon: the sum of boundary integrals of its lit region, as a share of its
// area, and which classes it certainly or perhaps holds.
//
// Certified sums are integers of 2^-60 that wrap around, so that they do not depend on the order,
// and so not on the threads: a partial sum may be of any size, and the true sum is within [0, 1].
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SUMS_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SUMS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "algorithms/contour/numbers.h"

namespace gnomon {

/// Bits of what a polygon holds.
enum ContourFlags : std::uint8_t {
  kHoldsLit = 1,     // a region that is certainly lit, of some area
  kHoldsShadow = 2,  // one certainly in shadow
  kPerhapsLit = 4,   // one that is lit if it is there at all
  kPerhapsShadow = 8,
  kContourOpen = 16,  // the bounds leave open where its regions are: to be found otherwise
};

template <class Numbers>
struct ContourSum {
  using T = typename Numbers::T;
  T value{};
  std::uint8_t flags = 0;

  void add(const T& share, double) { value += share; }
  void operator+=(const ContourSum& other) {
    value += other.value;
    flags |= other.flags;
  }
};

template <>
struct ContourSum<ContourNumbers<double, Trust::kCertified>> {
  static constexpr int kBits = 60;
  static constexpr std::uint64_t kMostError = std::uint64_t{1} << kBits;

  std::uint64_t units = 0;  // modulo 2^64
  std::uint64_t error = 0;
  std::uint8_t flags = 0;

  /// Adds a share within [-2, 2] that is off by at most `bound`.
  void add(double share, double bound) {
    if (!(std::fabs(share) <= 2) || !(bound < 1)) {
      flags |= kContourOpen;
      return;
    }
    constexpr double kUnits = 0x1p60;
    units += static_cast<std::uint64_t>(static_cast<std::int64_t>(share * kUnits));
    error = std::min(kMostError, error + 2 + static_cast<std::uint64_t>(bound * kUnits));
  }
  void operator+=(const ContourSum& other) {
    units += other.units;
    error = std::min(kMostError, error + other.error);
    flags |= other.flags;
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SUMS_H
