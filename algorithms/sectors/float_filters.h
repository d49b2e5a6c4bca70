// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes and depths of polygons in a chart, as certified floats: they decide most questions about
// two polygons for certain, before any exact one is asked. Bodies of sector_tree.h.
#ifndef GNOMON_ALGORITHMS_SECTORS_FLOAT_FILTERS_H
#define GNOMON_ALGORITHMS_SECTORS_FLOAT_FILTERS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "algorithms/sectors/sector_tree.h"

namespace gnomon {

template <SectorSpaceModel Space>
void SectorTree<Space>::locate(const LightChart& chart, SectorItem& item) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const LoopView<Vertex> loop = view(item);
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high{-kInfinity, -kInfinity, -kInfinity};
  bool known = true;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const ChartPoint p = chart_point(chart, loop.corner(i));
    low = {std::min(low[0], p.u - p.uv_error), std::min(low[1], p.v - p.uv_error),
           std::min(low[2], p.z - p.z_error)};
    high = {std::max(high[0], p.u + p.uv_error), std::max(high[1], p.v + p.uv_error),
            std::max(high[2], p.z + p.z_error)};
    known = known && p.uv_error < kInfinity && p.z_error < kInfinity;
  }
  const bool finite = known && std::fabs(low[0]) < kInfinity && std::fabs(low[1]) < kInfinity &&
                      std::fabs(high[0]) < kInfinity && std::fabs(high[1]) < kInfinity;
  if (!finite) {
    low = {-kInfinity, -kInfinity, -kInfinity};
    high = {kInfinity, kInfinity, kInfinity};
  }
  item.low = {float_below(low[0]), float_below(low[1])};
  item.high = {float_above(high[0]), float_above(high[1])};
  item.z_low = float_below(low[2]);
  item.z_high = float_above(high[2]);
}

template <SectorSpaceModel Space>
ChartBox SectorTree<Space>::box_of(const LightChart& chart, const LoopView<Vertex>& loop) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low_u = kInfinity, low_v = kInfinity, high_u = -kInfinity, high_v = -kInfinity;
  double error = 0;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const ChartPoint p = chart_point(chart, loop.corner(i));
    low_u = std::min(low_u, p.u);
    low_v = std::min(low_v, p.v);
    high_u = std::max(high_u, p.u);
    high_v = std::max(high_v, p.v);
    error = std::max(error, p.uv_error);
  }
  if (!(error < kInfinity)) return {};
  ChartBox box;
  box.low = {float_below(low_u - error), float_below(low_v - error)};
  box.high = {float_above(high_u + error), float_above(high_v + error)};
  return box;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_FLOAT_FILTERS_H
