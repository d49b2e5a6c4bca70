// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether a whole triangle of a receiver is in the deep umbra of a light, or all of it sees a
// common part of the light, or neither can be said: the conservative step of deep_umbra.h.
//
// Exactness: kDeep and kSeen are proven by exact decisions. A triangle around a point that sees
// something, or one all of whose points and whose border are hidden strictly, is decided once it is
// small enough. Proof: docs/illumination.md, "Deep umbra".
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_UMBRA_CELL_H
#define GNOMON_ALGORITHMS_ILLUMINATION_UMBRA_CELL_H

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/illumination/cell_shadow.h"
#include "algorithms/illumination/edge_lines.h"
#include "algorithms/illumination/light_view.h"
#include "algorithms/illumination/visible_pieces.h"

namespace gnomon {

/// A triangle of a receiver's plane: three points on the grid over one denominator.
struct UmbraCell {
  std::array<ExactVector, 3> points;
  mpz_class weight;  // positive

  /// The two halves at the middle of the longest edge.
  std::array<UmbraCell, 2> halves(const Geometry& geometry) const;
};

enum class CellAnswer : std::uint8_t { kDeep, kSeen, kUndecided };

class UmbraCells {
 public:
  /// For one side of a part. Keeps references.
  UmbraCells(const LightView& view, const EdgeLines& lines, const Part& part, Side side)
      : view_(view), lines_(lines), part_(part), side_(side) {}

  /// Finds all casters that may hide something of the light from some point of the cell.
  std::vector<CasterSide> casters_of(const UmbraCell& cell) const;
  /// Decides a cell. `casters`: a superset of casters_of(cell), from which it removes others.
  CellAnswer decide(const UmbraCell& cell, std::vector<CasterSide>& casters) const;

 private:
  const LightView& view_;
  const EdgeLines& lines_;
  const Part& part_;
  Side side_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_UMBRA_CELL_H
