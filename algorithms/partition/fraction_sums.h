// SPDX-License-Identifier: LGPL-3.0-or-later
// Sums of area fractions per part that do not depend on the order, and so not on the threads, in
// which they are added: fixed-point integers of 2^-60, whose addition is associative.
//
// Exactness: an enclosure is rounded outwards, so a certified sum encloses the true one; each
// summand costs at most 2^-57 of width. 16 bytes a part.
#ifndef GNOMON_ALGORITHMS_PARTITION_FRACTION_SUMS_H
#define GNOMON_ALGORITHMS_PARTITION_FRACTION_SUMS_H

#include <atomic>
#include <cstdint>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "kernel/signs/ball.h"

namespace gnomon {

/// Two sums a part; thread-safe.
class FractionSums {
 public:
  explicit FractionSums(std::size_t parts) : first_(parts), second_(parts) {}

  /// Certified: adds an enclosure; the two sums are its lower and upper ends. Requires: within
  /// [-1, 2].
  void add_enclosure(std::uint32_t part, const Ball& fraction);
  /// Bounds of the sum of enclosures, within [0, 1].
  Interval enclosure(std::uint32_t part) const;

  /// Rounded kernels: adds to the sum of lit or of shadowed fractions, as it came out.
  void add_rounded(std::uint32_t part, bool lit, double fraction);
  double rounded(std::uint32_t part, bool lit) const;

 private:
  static constexpr int kBits = 60;
  /// No sum of fractions comes near it: what is not a number, or far too large, was added.
  static constexpr std::int64_t kPoison = std::int64_t{1} << 62;

  std::vector<std::atomic<std::int64_t>> first_, second_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_FRACTION_SUMS_H
