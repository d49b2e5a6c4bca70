// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/sectors/sector_split.h"

#include <algorithm>
#include <cmath>

#include "algorithms/partition/kd_tree.h"

namespace gnomon {
namespace {

// Bins that a double cannot tell apart: relative to the coordinates, and where these are about 0.
constexpr double kNarrowestBin = 1e-15;
constexpr double kNarrowestAtZero = 1e-17;

/// A value within the given width of `near` that has few bits.
ChartSplit short_split(int axis, double near, double width) {
  ChartSplit split;
  split.axis = axis;
  split.bits = std::clamp(-std::ilogb(width) + 2, 0, 60);
  split.steps = std::llround(std::ldexp(near, split.bits));
  split.value = std::ldexp(static_cast<double>(split.steps), -split.bits);
  return split;
}

}  // namespace

std::optional<ChartSplit> SplitChooser::choose(std::span<const SectorItem> items) {
  const std::size_t n = items.size();
  std::optional<ChartSplit> best;
  double best_cost = kSplitGrowth * n_log_n(n);
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    float low = INFINITY, high = -INFINITY;
    for (const SectorItem& item : items) {
      if (item.low[k] > -INFINITY) low = std::min(low, item.low[k]);
      if (item.high[k] < INFINITY) high = std::max(high, item.high[k]);
    }
    const double width = (static_cast<double>(high) - static_cast<double>(low)) / kBins;
    if (!(width > kNarrowestBin * std::max(std::fabs(low), std::fabs(high))) ||
        !(width > kNarrowestAtZero)) {
      continue;
    }
    // starts[i], ends[i]: boxes that begin, end in bin i.
    std::array<std::uint32_t, kBins> starts{}, ends{};
    const auto bin = [&](float value) {
      const double position = (static_cast<double>(value) - static_cast<double>(low)) / width;
      return static_cast<std::size_t>(std::clamp(position, 0.0, kBins - 1.0));
    };
    for (const SectorItem& item : items) {
      ++starts[bin(item.low[k])];
      ++ends[bin(item.high[k])];
    }
    std::size_t below = 0, ended = 0;
    for (int i = 1; i < kBins; ++i) {
      below += starts[static_cast<std::size_t>(i) - 1];
      ended += ends[static_cast<std::size_t>(i) - 1];
      const std::size_t above = n - ended;
      if (below == n || above == n) continue;
      const double cost = n_log_n(below) + n_log_n(above);
      if (cost >= best_cost) continue;
      best_cost = cost;
      best = short_split(axis, static_cast<double>(low) + i * width, width);
    }
  }
  return best;
}

}  // namespace gnomon
