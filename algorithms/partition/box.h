// SPDX-License-Identifier: LGPL-3.0-or-later
// An axis-aligned box of doubles. Whoever makes one says what its coordinates count, and whether it
// encloses for certain or only guides a heuristic.
#ifndef GNOMON_ALGORITHMS_PARTITION_BOX_H
#define GNOMON_ALGORITHMS_PARTITION_BOX_H

#include <array>
#include <cstddef>
#include <limits>

namespace gnomon {

/// Empty by default.
struct Box {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high{-kInfinity, -kInfinity, -kInfinity};

  void add(const std::array<double, 3>& point) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = point[k] < low[k] ? point[k] : low[k];
      high[k] = point[k] > high[k] ? point[k] : high[k];
    }
  }
  void add(const Box& other) {
    add(other.low);
    add(other.high);
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_BOX_H
