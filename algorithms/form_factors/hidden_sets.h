// SPDX-License-Identifier: LGPL-3.0-or-later
// What one side of a caster hides of a target from a triangle: the part that all points of the
// triangle have hidden, and a set that holds whatever any of them has hidden. Both are
// intersections of half-spaces; docs/illumination.md, "Deep umbra", derives them, here they are in
// doubles with a margin (target_pieces.h).
#ifndef GNOMON_ALGORITHMS_FORM_FACTORS_HIDDEN_SETS_H
#define GNOMON_ALGORITHMS_FORM_FACTORS_HIDDEN_SETS_H

#include <array>
#include <optional>
#include <vector>

#include "algorithms/form_factors/target_pieces.h"
#include "algorithms/form_factors/vectors.h"

namespace gnomon {

using CellTriangle = std::array<Vector, 3>;

/// One side of a caster: what starts in front of it is stopped. Counter-clockwise from there.
struct BlockingSide {
  std::vector<Vector> loop;
  HalfSpace plane;
};

struct HiddenSets {
  std::optional<std::vector<HalfSpace>> from_all;  // none: nothing
  std::optional<std::vector<HalfSpace>> from_any;  // none: nothing
};

HiddenSets hidden_sets(const BlockingSide& caster, const CellTriangle& cell);
/// What it hides from one point; none if nothing.
std::optional<std::vector<HalfSpace>> hidden_from(const BlockingSide& caster, const Vector& point);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FORM_FACTORS_HIDDEN_SETS_H
