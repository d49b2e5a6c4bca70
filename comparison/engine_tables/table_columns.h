// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of a scene each column of a table means.
#ifndef GNOMON_COMPARISON_ENGINE_TABLES_TABLE_COLUMNS_H
#define GNOMON_COMPARISON_ENGINE_TABLES_TABLE_COLUMNS_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/scene.h"

namespace gnomon::comparison {

struct TableSide {
  std::uint32_t polygon = 0;
  Side side = Side::kFront;
  bool gross = false;  // with the windows in its holes (report/shares/gross_shares.h)
};

struct TableColumn : TableSide {
  std::uint32_t column = 0;  // of the table's names
};

struct TableColumns {
  std::vector<TableColumn> matched;    // in the order of the table
  std::vector<std::uint32_t> unknown;  // columns that name no side, or none that is certain
  std::vector<TableSide> untold;       // sides without a column, in the order of the scene
};

/// "ID", "ID#back" or "ID#gross".
std::string side_name(const Scene& scene, const TableSide& side);

/// By exact names (also "ID#back" for the backs of polygons with two sides, and "ID#gross" for
/// those with holes, which are not missed where they are untold), else without regard to case where
/// that leaves one side to one column. Characters that no id holds are taken as readers of scenes
/// write them ("%23"), and "Mir-ID", as EnergyPlus calls the other side of shading, as the back.
TableColumns match_columns(const std::vector<std::string>& names, const Scene& scene);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_TABLE_COLUMNS_H
