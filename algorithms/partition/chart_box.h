// SPDX-License-Identifier: LGPL-3.0-or-later
// A box in a chart of light space, certified to hold what it is the box of.
#ifndef GNOMON_ALGORITHMS_PARTITION_CHART_BOX_H
#define GNOMON_ALGORITHMS_PARTITION_CHART_BOX_H

#include <array>
#include <cmath>
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

/// Returns a float that is not larger than a double, so that bounds in doubles become certified
/// floats. A double above all floats gets the largest float, and not infinity.
inline float float_below(double x) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const double below = x - std::fabs(x) * 0x1p-22 - 0x1p-140;
  if (below >= static_cast<double>(kMost)) return kMost;
  if (below <= -static_cast<double>(kMost)) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(below);
}
inline float float_above(double x) { return -float_below(-x); }

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_CHART_BOX_H
