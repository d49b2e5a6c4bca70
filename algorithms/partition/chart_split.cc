// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/chart_split.h"

#include <algorithm>

namespace gnomon {

// q_axis / q_w > steps / 2^bits, times 2^bits |q_w|. A directional light's chart is in units of 2^b
// grid steps and q_w is the common denominator: times 2^b.
PrefixPlane plane_of(const ChartSplit& split, const LightChart& chart, bool directional,
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
