// SPDX-License-Identifier: LGPL-3.0-or-later
// One convex part of a polygon, seen from which a target is more or less hidden: bounds of its form
// factor by triangles that are halved, those that tell least first.
#ifndef GNOMON_ALGORITHMS_FORM_FACTORS_FACTOR_CELLS_H
#define GNOMON_ALGORITHMS_FORM_FACTORS_FACTOR_CELLS_H

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/form_factors/hidden_sets.h"
#include "algorithms/form_factors/target_pieces.h"
#include "algorithms/form_factors/vectors.h"

namespace gnomon {

/// A part that looks, and what it looks at.
struct FactorTask {
  std::vector<Vector> loop;          // convex, counter-clockwise seen from the side that looks
  Vector normal{};                   // of that side, of length 1
  std::vector<TargetPiece> target;   // in front of it, disjoint
  std::vector<BlockingSide> blocks;  // whatever may hide some of the target
};

/// Sums over the part's area.
struct FactorSums {
  double value = 0, lower = 0, upper = 0, unobstructed = 0;
  std::uint64_t cells = 0;
};

/// Halves cells until upper - lower <= gap, or there are most_cells of them. Returns early if
/// interrupted; then the bounds hold, too.
FactorSums factor_sums(const FactorTask& task, double gap, std::uint64_t most_cells,
                       const std::atomic<bool>* interrupted);

double area_of(std::span<const Vector> loop);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FORM_FACTORS_FACTOR_CELLS_H
