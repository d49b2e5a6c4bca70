// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of tables of shares: all polygons that were not dropped, and the backs of those with
// two sides, in the order of the scene.
#ifndef GNOMON_REPORT_SHARES_SHARE_COLUMNS_H
#define GNOMON_REPORT_SHARES_SHARE_COLUMNS_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/sides/part_weights.h"
#include "report/sides/polygon_sides.h"

namespace gnomon::report {

class ShareColumns {
 public:
  /// Keeps references to the scenes.
  ShareColumns(const Scene& scene, const PreparedScene& prepared);

  std::size_t size() const { return columns_.size(); }
  std::uint32_t polygon(std::size_t column) const { return columns_[column].polygon; }
  Side side(std::size_t column) const { return columns_[column].side; }
  /// The polygon's id, "#back" after it for a back; no id holds a "#".
  std::string name(std::size_t column) const;
  std::vector<std::string> names() const;
  /// Of one column under a light.
  Shares shares(const LightResult& light, std::size_t column) const {
    return side_shares(*prepared_, light, polygon(column), side(column), weights_);
  }
  /// The lit shares of all columns; 0 for a side that does not face the light. Requires:
  /// lit.size() == size().
  void read_lit(const LightResult& light, std::span<double> lit) const;

 private:
  struct Column {
    std::uint32_t polygon;
    Side side;
  };
  const Scene* scene_;
  const PreparedScene* prepared_;
  PartWeights weights_;
  std::vector<Column> columns_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SHARES_SHARE_COLUMNS_H
