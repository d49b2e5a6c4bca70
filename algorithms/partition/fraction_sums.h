// SPDX-License-Identifier: LGPL-3.0-or-later
// Sums of area fractions per part that do not depend on the order, and so not on the threads, in
// which they are added: fixed-point integers, whose addition is associative.
//
// Exactness: an enclosure is rounded outwards, so a certified sum encloses the true one. Its ends
// are integers of 2^-120 in two words each: the width that a summand costs is lost in its own. 32
// bytes a part.
#ifndef GNOMON_ALGORITHMS_PARTITION_FRACTION_SUMS_H
#define GNOMON_ALGORITHMS_PARTITION_FRACTION_SUMS_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/partition/pair_area.h"
#include "gnomon/algorithms/shadow_result.h"
#include "kernel/numbers/exact_integer.h"
#include "kernel/signs/ball.h"

namespace gnomon {

/// Thread-safe; sums are read when all has been added.
class FractionSums {
 public:
  explicit FractionSums(std::size_t parts) : words_(kWords * parts) {}

  /// Certified: adds an enclosure. Requires: within [-1, 2].
  void add_enclosure(std::uint32_t part, const PairBall& fraction);
  void add_enclosure(std::uint32_t part, const Ball& fraction) {
    add_enclosure(part, PairBall(fraction));
  }
  /// Bounds of the sum of enclosures, within [0, 1]; and of what is left to 1, which is known as
  /// well however small it is.
  Interval enclosure(std::uint32_t part) const;
  Interval rest(std::uint32_t part) const;

  /// Rounded kernels: adds to the sum of lit or of shadowed fractions, as it came out.
  void add_rounded(std::uint32_t part, bool lit, double fraction);
  double rounded(std::uint32_t part, bool lit) const;

 private:
  /// Of both ends, the low and the high one. Rounded sums are the first two.
  static constexpr std::size_t kWords = 4;
  static constexpr int kBits = 120, kRoundedBits = 60;
  /// No rounded sum of fractions comes near it: what is not a number, or far too large, was added.
  static constexpr std::int64_t kPoison = std::int64_t{1} << 62;

  /// end: 0 for the lower one, 1 for the upper one.
  void add_fixed(std::uint32_t part, std::size_t end, Int128 value);
  Int128 fixed(std::uint32_t part, std::size_t end) const;

  std::vector<std::atomic<std::int64_t>> words_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_FRACTION_SUMS_H
