// SPDX-License-Identifier: LGPL-3.0-or-later
// A box in a chart of light space, certified to hold what it is the box of.
#ifndef GNOMON_ALGORITHMS_PARTITION_CHART_BOX_H
#define GNOMON_ALGORITHMS_PARTITION_CHART_BOX_H

#include <array>
#include <limits>

namespace gnomon {

/// By default everything.
struct ChartBox {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 2> low{-kInfinity, -kInfinity}, high{kInfinity, kInfinity};

  bool overlaps(const ChartBox& other) const {
    return low[0] < other.high[0] && other.low[0] < high[0] && low[1] < other.high[1] &&
           other.low[1] < high[1];
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_CHART_BOX_H
