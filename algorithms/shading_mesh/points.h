// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact points of a shading mesh: each position once, with its nearest doubles. Points are
// homogeneous integers without common factor, so that equal points have equal numbers and a hash of
// the numbers finds them; differences of rationals, with a gcd each, are never formed.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_POINTS_H
#define GNOMON_ALGORITHMS_SHADING_MESH_POINTS_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "gnomon/algorithms/shading_mesh.h"

namespace gnomon {

/// Converts a point exactly. Requires: canonical rationals.
ExactPoint exact_point(const std::array<mpq_class, 3>& point);
/// Divides by the common factor and makes the denominator positive.
void make_primitive(ExactPoint& point);
std::array<double, 3> nearest_doubles(const ExactPoint& point);
/// The point in the middle of two.
ExactPoint middle(const ExactPoint& a, const ExactPoint& b);
/// The sign of a's coordinate minus b's.
int compare(const ExactPoint& a, const ExactPoint& b, int axis);

/// A point with its nearest doubles, ready to be numbered.
struct NewPoint {
  ExactPoint exact;
  std::array<double, 3> nearest{};
};
NewPoint new_point(ExactPoint exact);

/// PointTable numbers positions, each once, in the order in which they are inserted.
class PointTable {
 public:
  PointTable() : numbers_(0, Hash{this}, Equal{this}) {}
  PointTable(const PointTable&) = delete;
  PointTable& operator=(const PointTable&) = delete;

  std::uint32_t insert(NewPoint point);
  std::size_t size() const { return exact_.size(); }
  const ExactPoint& exact(std::uint32_t number) const { return exact_[number]; }
  const std::array<double, 3>& nearest(std::uint32_t number) const { return nearest_[number]; }
  /// The points, taken out of the table.
  std::vector<ExactPoint>& exact_points() { return exact_; }

  /// The sign of a's coordinate minus b's: rounding to the nearest double keeps the order, so that
  /// only equal doubles need the exact numbers.
  int compare(std::uint32_t a, std::uint32_t b, int axis) const;

 private:
  struct Hash {
    const PointTable* table;
    std::size_t operator()(std::uint32_t number) const { return table->hashes_[number]; }
  };
  struct Equal {
    const PointTable* table;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return table->hashes_[a] == table->hashes_[b] && table->exact_[a] == table->exact_[b];
    }
  };

  std::vector<ExactPoint> exact_;
  std::vector<std::array<double, 3>> nearest_;
  std::vector<std::uint64_t> hashes_;
  std::unordered_set<std::uint32_t, Hash, Equal> numbers_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_POINTS_H
