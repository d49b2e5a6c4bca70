// SPDX-License-Identifier: LGPL-3.0-or-later
// The pairs of one strip: its boxes are sorted by their low u, and each is tested with those that
// start before it ends.
#ifndef GNOMON_ALGORITHMS_CONTOUR_STRIP_SWEEP_H
#define GNOMON_ALGORITHMS_CONTOUR_STRIP_SWEEP_H

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/contour/lanes/lanes.h"
#include "algorithms/contour/strip_entries.h"

namespace gnomon {

/// Numbers of entries, two by two.
struct EntryPairs {
  std::vector<std::uint32_t> first, second;
  std::uint64_t used = 0;
};

/// What the sweeps of one thread need, kept from strip to strip and from light to light.
class StripSweep {
 public:
  /// Forgets the pairs of all strips.
  void clear() { pairs_.used = 0; }

  /// Sorts the strip's entries, finds its pairs and puts the number of pairs of each entry into
  /// `counts`. Pairs are in terms of the sorted entries, of which `slots` and `owners` get what
  /// belongs to them. Returns false, and leaves the pairs incomplete, as soon as there are more
  /// than `most` pairs in the strip.
  bool run(const Lanes& lanes, const StripEntries& entries, std::uint32_t strip, std::uint64_t most,
           std::uint32_t* slots, std::uint32_t* owners, std::uint32_t* counts);

  const EntryPairs& pairs() const { return pairs_; }

 private:
  struct List {
    std::vector<float> low_u, low_v, high_u, high_v;
    std::vector<std::uint32_t> traits;
  };
  SweepList sorted(const StripEntries& entries, std::uint32_t begin, std::uint32_t end, List& list,
                   std::uint32_t* slots, std::uint32_t* owners);
  void sort_keys(std::uint32_t count);
  template <unsigned kBits>
  void sort_by_digits(std::uint32_t count);
  bool sweep(const Lanes& lanes, const SweepList& queries, const SweepList& targets,
             SweepOrder order, std::uint64_t most, std::uint32_t* counts);

  std::vector<std::uint64_t> keys_, other_keys_;  // low u above the number in the list
  std::array<List, 2> lists_;
  EntryPairs pairs_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_STRIP_SWEEP_H
