// SPDX-License-Identifier: GPL-3.0-or-later
// Which cells of the overlay of truth and claims err by rounding alone (geometry/rounding.h): all
// of such a cell lies near its own edges, which are borders of something, or near edges of claimed
// loops that cancelled in the overlay.
#ifndef GNOMON_ORACLE_JUDGE_ROUNDING_CELLS_H
#define GNOMON_ORACLE_JUDGE_ROUNDING_CELLS_H

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "oracle/geometry/box_tree.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/overlay.h"
#include "oracle/geometry/plane_frame.h"
#include "oracle/geometry/rounding.h"

namespace gnomon::oracle {

class RoundingCells {
 public:
  using Edges = std::vector<std::pair<ChartPoint, ChartPoint>>;

  /// `claimed`: the edges of all claimed loops. `radius`: 0 if nothing is excused. Keeps references
  /// to all but the number.
  RoundingCells(const PlaneFrame& frame, const Chart& chart, const Overlay& overlay,
                const Edges& claimed, long double radius)
      : frame_(frame), chart_(chart), overlay_(overlay), claimed_(claimed), radius_(radius) {}

  bool contains(std::uint32_t face);
  /// A vertex of the overlay in the frame.
  const PlanarPoint& at_vertex(std::uint32_t vertex);

 private:
  struct ClaimedBorders {
    std::vector<Border> borders;
    BoxTree tree;
    long double area = 0;  // of what is near any of them, at most
  };

  PlanarPoint at(const ChartPoint& point) const { return frame_.at(chart_.lift(point)); }
  const ClaimedBorders& claimed_borders();
  bool is_too_large(const std::vector<Border>& boundary);
  bool is_near_claims(const PlanarLoop& piece, std::vector<Border> borders);

  const PlaneFrame& frame_;
  const Chart& chart_;
  const Overlay& overlay_;
  const Edges& claimed_;
  long double radius_;
  // Made when first asked for.
  std::optional<ClaimedBorders> claimed_borders_;
  std::vector<std::optional<PlanarPoint>> places_;  // by vertex
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_ROUNDING_CELLS_H
