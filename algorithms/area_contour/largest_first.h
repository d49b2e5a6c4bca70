// SPDX-License-Identifier: LGPL-3.0-or-later
// The order of things by their sizes, the largest first.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_LARGEST_FIRST_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_LARGEST_FIRST_H

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::area_contour {

class LargestFirst {
 public:
  void clear() { keys_.clear(); }
  /// Adds the next thing: they are numbered from 0. `size`: not negative.
  void add(float size) {
    // The bits of numbers that are not negative are in their order.
    keys_.push_back(std::uint64_t{~std::bit_cast<std::uint32_t>(size)} << 32 | keys_.size());
  }
  /// The numbers of all that were added, equal ones in the order of these.
  std::span<const std::uint32_t> sorted() {
    std::ranges::sort(keys_);
    numbers_.clear();
    for (const std::uint64_t key : keys_) numbers_.push_back(static_cast<std::uint32_t>(key));
    return numbers_;
  }

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_LARGEST_FIRST_H
