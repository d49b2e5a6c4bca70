// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes around polygons in a chart of the light's directions, as the search for pairs reads them.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CHART_BOXES_H
#define GNOMON_ALGORITHMS_CONTOUR_CHART_BOXES_H

#include <cstdint>
#include <span>

namespace gnomon {

/// Closed boxes [low_u, high_u] x [low_v, high_v], as arrays of equal length. Ends may be infinite.
/// Requires: no NaN; low <= high.
struct ChartBoxes {
  std::span<const float> low_u, low_v, high_u, high_v;
  /// Whose box each is, at most one of an owner in a chart. Empty: box i is that of owner i.
  std::span<const std::uint32_t> owners;

  std::uint32_t size() const { return static_cast<std::uint32_t>(low_u.size()); }
  std::uint32_t owner(std::uint32_t box) const { return owners.empty() ? box : owners[box]; }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CHART_BOXES_H
