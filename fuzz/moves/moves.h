// SPDX-License-Identifier: GPL-3.0-or-later
// Degenerate moves: each puts one kind of degeneracy into a scene, by adding a polygon or a light
// made to fit what is there, or by changing all of it. They combine in any order; the generator
// applies them in the order of the table, in which none undoes much of what those before it did.
//
// Exactness: what a move puts in a plane, on a line or at a vertex is exactly there; where the
// scene's numbers have no room for such a point the move tries others, and gives up in the end.
// Only moves that are near something on purpose round.
#ifndef GNOMON_FUZZ_MOVES_MOVES_H
#define GNOMON_FUZZ_MOVES_MOVES_H

#include <cstdint>
#include <span>
#include <string_view>

#include "fuzz/scene/kinds.h"
#include "gnomon/scene/scene.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {

enum class MoveGroup : std::uint8_t {
  kPolygon,  // adds a polygon, or changes one
  kLight,    // adds or replaces a point or directional light, or adds what lines up with one
  kArea,     // adds or replaces an area light
  kWhole,    // changes all coordinates
};

struct Move {
  Kind kind = Kind::kCoplanar;  // its name is the kind's
  MoveGroup group = MoveGroup::kPolygon;
  /// False if it found no place, the scene then being in no particular state. Requires: a polygon.
  bool (*apply)(Scene& scene, Random& random) = nullptr;
  bool large = false;  // adds so many polygons that it is made only when asked for by name

  std::string_view name() const { return kinds()[id_of(kind)].name; }
};

/// All moves, in the order in which they are applied.
std::span<const Move> moves();
const Move* move_by_name(std::string_view name);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_MOVES_MOVES_H
