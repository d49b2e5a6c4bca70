// SPDX-License-Identifier: LGPL-3.0-or-later
// A split of a chart of light space (kernel/concept/light_space.h), and the plane through the light
// that it stands for.
//
// Exactness: the value of a split is a short binary fraction, so that its plane is exact in every
// kernel.
#ifndef GNOMON_ALGORITHMS_PARTITION_CHART_SPLIT_H
#define GNOMON_ALGORITHMS_PARTITION_CHART_SPLIT_H

#include <cstdint>

#include "kernel/concept/light_space.h"

namespace gnomon {

/// u = value or v = value; the value is exactly `steps` * 2^-bits.
struct ChartSplit {
  int axis = 0;  // 0: u, 1: v
  double value = 0;
  std::int64_t steps = 0;
  int bits = 0;
};

/// The plane of a split in the coordinates of q; its front is where the coordinate is larger.
/// `grid_bits`: b of the scene (the unit of a directional light's chart).
PrefixPlane plane_of(const ChartSplit& split, const LightChart& chart, bool directional,
                     unsigned grid_bits);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_CHART_SPLIT_H
