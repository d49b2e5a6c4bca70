// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/rounding_cells.h"

#include <gtest/gtest.h>

#include "oracle/geometry/group_overlay.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

class RoundingCellsOfRectangle : public testing::Test {
 protected:
  ChartPoint at(const mpq_class& x, const mpq_class& y) const {
    return chart.project(to_grid(built.prepared.geometry, RationalPoint{x, y, 0}));
  }
  /// Whether a cell of that size is all rounding of radius 1, beside claimed edges.
  bool is_rounding(int length, int width, const RoundingCells::Edges& claimed) const {
    Overlay overlay;
    overlay.add_loop({at(0, 0), at(length, 0), at(length, width), at(0, width)}, kLit);
    overlay.build();
    EXPECT_EQ(overlay.faces().size(), 2u);
    return RoundingCells(frame, chart, overlay, claimed, 1).contains(1);
  }

  const BuiltScene built = SceneBuilder()
                               .polygon("r", {{0, 0, 0}, {16, 0, 0}, {16, 16, 0}, {0, 16, 0}})
                               .sun("s", {0, 0, 1})
                               .build();
  const Chart chart{support_of(built.prepared, 0)};
  const PlaneFrame frame{built.prepared.geometry, grid_loop(built.prepared, 0)};
};

TEST_F(RoundingCellsOfRectangle, WhatIsNearItsOwnEdges) {
  EXPECT_TRUE(is_rounding(10, 1, {}));
  EXPECT_TRUE(is_rounding(10, 2, {}));
  EXPECT_FALSE(is_rounding(10, 3, {}));
}

/// A loop that rounds to a line has edges that cancel: the overlay has none of them.
TEST_F(RoundingCellsOfRectangle, WhatIsNearClaimedEdgesThatCancelled) {
  const mpq_class middle(3, 2);
  EXPECT_TRUE(
      is_rounding(10, 3, {{at(0, middle), at(10, middle)}, {at(10, middle), at(0, middle)}}));
  EXPECT_FALSE(is_rounding(10, 3, {{at(0, middle), at(5, middle)}}));
  EXPECT_FALSE(is_rounding(10, 3, {{at(0, 9), at(10, 9)}}));
}

}  // namespace
}  // namespace gnomon::oracle
