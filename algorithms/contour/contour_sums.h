// SPDX-License-Identifier: LGPL-3.0-or-later
// What is known of each polygon: the sum of boundary integrals of its lit region, as a share of its
// area, and which classes it certainly or perhaps holds.
//
// Certified sums are integers of 2^-92 that wrap around, so that they do not depend on the order,
// and so not on the threads: a partial sum may be of any size, and the true sum is within [0, 1].
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SUMS_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SUMS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "algorithms/contour/numbers.h"
#include "kernel/numbers/exact_integer.h"

namespace gnomon {

/// Bits of what a polygon holds.
enum ContourFlags : std::uint8_t {
  kHoldsLit = 1,     // a region that is certainly lit, of some area
  kHoldsShadow = 2,  // one certainly in shadow
  kPerhapsLit = 4,   // one that is lit if it is there at all
  kPerhapsShadow = 8,
  kContourOpen = 16,  // the bounds leave open where its regions are: to be found otherwise
  kOwnWhole = 32,     // all of its own border is seen: that is 1, besides its sum
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
  static constexpr int kErrorBits = 76;
  /// No sum that is off by as much is of use.
  static constexpr std::uint64_t kMostError = std::uint64_t{1} << (kErrorBits - 16);

  std::uint64_t units = 0;  // of 2^-60, modulo 2^64
  std::uint64_t error = 0;  // of 2^-76
  std::uint32_t rest = 0;   // of 2^-92, besides
  std::uint8_t flags = 0;

  /// Adds a share within [-2, 2] that is off by at most `bound`.
  void add(double share, double bound) {
    if (!(std::fabs(share) <= 2) || !(bound < 0x1p-16)) {
      flags |= kContourOpen;
      return;
    }
    // The remainder is exactly a double, and what its conversion cuts off is below 2^-92.
    const double scaled = share * 0x1p60;
    const auto whole = static_cast<std::int64_t>(scaled);
    const double remainder = scaled - static_cast<double>(whole);
    add_units(whole, static_cast<std::int64_t>(remainder * 0x1p32));
    error = std::min(kMostError, error + 2 + static_cast<std::uint64_t>(bound * 0x1p76));
  }
  void operator+=(const ContourSum& other) {
    add_units(static_cast<std::int64_t>(other.units), other.rest);
    error = std::min(kMostError, error + other.error);
    flags |= other.flags;
  }
  /// The sum, off by at most u of it; and what it and that are off by.
  double middle() const {
    const Int128 all =
        static_cast<Int128>(static_cast<std::int64_t>(units)) * (Int128{1} << 32) + rest;
    return static_cast<double>(all) * 0x1p-92;
  }
  double radius() const { return static_cast<double>(error) * 0x1p-76; }

 private:
  /// Units of 2^-60, and less than one of them in units of 2^-92.
  void add_units(std::int64_t whole, std::int64_t part) {
    rest += static_cast<std::uint32_t>(part);
    const bool carry = rest < static_cast<std::uint32_t>(part);
    units += static_cast<std::uint64_t>(whole + (part >> 32)) + (carry ? 1 : 0);
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SUMS_H
