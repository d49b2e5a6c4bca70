// SPDX-License-Identifier: GPL-3.0-or-later
// The predicates of kinds, a table for each theme. A new kind is a row of the table of its theme
// and the function that the row names.
#ifndef GNOMON_FUZZ_KINDS_PREDICATE_TABLES_H
#define GNOMON_FUZZ_KINDS_PREDICATE_TABLES_H

#include <span>

#include "fuzz/kinds/scene_view.h"
#include "fuzz/scene/kinds.h"

namespace gnomon::fuzz {

struct KindPredicate {
  Kind kind;
  bool (*holds)(const SceneView& scene);
};

/// Shapes of single polygons, and polygons to each other.
std::span<const KindPredicate> polygon_predicates();
/// Point and directional lights.
std::span<const KindPredicate> light_predicates();
std::span<const KindPredicate> area_light_predicates();
/// Sides, sizes, magnitudes and numbers of the whole scene.
std::span<const KindPredicate> whole_scene_predicates();

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_KINDS_PREDICATE_TABLES_H
