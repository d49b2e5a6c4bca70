// SPDX-License-Identifier: LGPL-3.0-or-later
// The rows of an angular table: how directions fall into slices of t, and which t stands for each
// (Thakur, Cheng & Miura, section 3.1). N slices between the least and the greatest t of all
// vertices, rounded outwards to 24 bits, each with its middle; or, for tables without rows, the
// slabs between the values of t that vertices have.
//
// A vertex is above a row if its t is more. Exact: all t are rational numbers.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_ROWS_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_ROWS_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/angular_table/table_mesh.h"

namespace gnomon {

class TableRows {
 public:
  /// `rows`: how many, or MethodOptionValues::kExactRows. `used`: indices of the vertices that
  /// count.
  TableRows(const TableMesh& mesh, std::span<const std::uint32_t> used, std::uint32_t rows);

  bool is_exact() const { return is_exact_; }
  std::uint32_t count() const { return count_; }
  /// How many rows a vertex that counts is above.
  std::uint32_t rank(std::uint32_t vertex) const { return ranks_[vertex]; }
  /// Which t stands for a row: the middle of its slice.
  const mpq_class& middle(std::uint32_t row) const { return middles_[row]; }
  /// Where slice k begins and slice k - 1 ends, k up to count().
  mpq_class border(std::uint32_t k) const;
  /// The slice that holds t.
  std::optional<std::uint32_t> holding(const mpq_class& t) const;
  /// The same, about: one that is there.
  std::uint32_t guess(double t) const;

 private:
  void make_slices(const TableMesh& mesh, std::span<const std::uint32_t> used,
                   const mpq_class& least, const mpq_class& greatest);

  bool is_exact_;
  std::uint32_t count_ = 0;
  std::vector<std::uint32_t> ranks_;  // by vertices of the mesh
  mpq_class low_, step_;              // of slices
  std::vector<mpq_class> middles_;    // by rows
  std::vector<mpq_class> values_;     // of slabs, ascending
  std::vector<double> near_values_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_ROWS_H
