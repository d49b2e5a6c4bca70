// SPDX-License-Identifier: LGPL-3.0-or-later
// The order of edges along a row: of two, the one whose s is less where it crosses. The edges are
// kept and no numbers: doubles decide where their error allows it, else rational numbers.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_ROW_ORDER_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_ROW_ORDER_H

#include <cstdint>

#include "algorithms/angular_table/table_mesh.h"
#include "algorithms/angular_table/table_rows.h"

namespace gnomon {

/// One row of a table. Edges that it is asked about cross it.
class RowOrder {
 public:
  RowOrder(const TableMesh& mesh, const mpq_class& t) : mesh_(mesh), t_(t), near_t_(t.get_d()) {}

  /// s where the edge crosses, as a double that is off by at most `error`.
  struct NearS {
    double s = 0, error = 0;
  };
  NearS near(std::uint32_t edge) const;
  mpq_class exact(std::uint32_t edge) const;
  /// Negative if the first is on the left of the second, 0 if they cross in one place.
  int compare(std::uint32_t first, std::uint32_t second) const {
    return compare(first, near(first), second, near(second));
  }
  int compare(std::uint32_t first, const NearS& near_first, std::uint32_t second,
              const NearS& near_second) const {
    if (first == second) return 0;
    const double apart = near_first.s - near_second.s;
    const double error = near_first.error + near_second.error;
    if (apart > error) return 1;
    if (apart < -error) return -1;
    return cmp(exact(first), exact(second));
  }

 private:
  const TableMesh& mesh_;
  mpq_class t_;
  double near_t_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_ROW_ORDER_H
