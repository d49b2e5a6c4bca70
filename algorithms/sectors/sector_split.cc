// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/sectors/sector_split.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

// Bins that a double cannot tell apart: relative to the coordinates, and where these are about 0.
constexpr double kNarrowestBin = 1e-15;
constexpr double kNarrowestAtZero = 1e-17;

/// A value within the given width of `near` that has few bits.
SectorSplit short_split(int axis, double near, double width) {
  SectorSplit split;
  split.axis = axis;
  split.bits = std::clamp(-std::ilogb(width) + 2, 0, 60);
  split.steps = std::llround(std::ldexp(near, split.bits));
  split.value = std::ldexp(static_cast<double>(split.steps), -split.bits);
  return split;
}

}  // namespace

double n_log_n(std::size_t n) {
  static const std::vector<double> kTable = [] {
    std::vector<double> table(4096, 0.0);
    for (std::size_t i = 2; i < table.size(); ++i) {
      table[i] = static_cast<double>(i) * std::log2(static_cast<double>(i));
    }
    return table;
  }();
  return n < kTable.size() ? kTable[n] : static_cast<double>(n) * std::log2(static_cast<double>(n));
}

std::optional<SectorSplit> SplitChooser::choose(std::span<const SectorItem> items) {
  const std::size_t n = items.size();
  std::optional<SectorSplit> best;
  double best_cost = kGrowth * n_log_n(n);
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

// q_axis / q_w > steps / 2^bits, times 2^bits |q_w|. A directional light's chart is in units of 2^b
// grid steps and q_w is the common denominator: times 2^b.
PrefixPlane plane_of(const SectorSplit& split, const LightChart& chart, bool directional,
                     unsigned grid_bits) {
  mpz_class scale = mpz_class(1) << static_cast<unsigned>(split.bits);
  mpz_class offset = static_cast<long>(split.steps);
  if (directional) {
    offset <<= grid_bits;
    const unsigned common = std::min(static_cast<unsigned>(split.bits), grid_bits);
    scale >>= common;
    offset >>= common;
  }
  PrefixPlane plane;
  plane.n[static_cast<std::size_t>(split.axis == 0 ? chart.u : chart.v)] = chart.sign * scale;
  plane.n[static_cast<std::size_t>(chart.w)] = -chart.sign * offset;
  return plane;
}

}  // namespace gnomon
