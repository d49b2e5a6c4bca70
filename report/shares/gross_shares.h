// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of whole walls, their windows and doors included, beside those of what is left of the wall
// around them.
//
// A polygon is an opening of another one if its loop is one of the other's holes, point by point.
#ifndef GNOMON_REPORT_SHARES_GROSS_SHARES_H
#define GNOMON_REPORT_SHARES_GROSS_SHARES_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/shares/share_columns.h"

namespace gnomon::report {

class GrossShares {
 public:
  /// No walls.
  GrossShares() = default;
  /// Walls with openings among the columns.
  GrossShares(const Scene& scene, const PreparedScene& prepared, const ShareColumns& columns);

  std::size_t size() const { return walls_.size(); }
  /// "ID#gross", of the wall's front.
  std::vector<std::string> names() const;
  /// From the shares of all columns: those of the wall and its openings, weighted by their areas.
  void read(std::span<const double> lit, std::span<double> gross) const;

 private:
  struct Weighted {
    std::size_t column;
    double weight;  // of the whole wall's area
  };
  struct Wall {
    std::string name;
    std::vector<Weighted> columns;
  };
  std::vector<Wall> walls_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SHARES_GROSS_SHARES_H
