// SPDX-License-Identifier: GPL-3.0-or-later
// Small random shapes on a lattice, for families of scenes in which exact degeneracy is the rule.
#ifndef GNOMON_FUZZ_GENERATE_RANDOM_SHAPES_H
#define GNOMON_FUZZ_GENERATE_RANDOM_SHAPES_H

#include <cstdint>
#include <vector>

#include "fuzz/generate/scene_pen.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {

/// Coordinates in [low, high].
Triple point_in(Random& random, std::int64_t low, std::int64_t high);
/// Components in [-size, size], not all zero.
Triple direction(Random& random, std::int64_t size);
/// Flags of the next polygon: mostly two-sided, some only receive.
void choose_flags(ScenePen& pen, Random& random);
/// A triangle, parallelogram, or a parallelogram with a corner cut off, of positive area.
std::vector<Triple> shape(Random& random, std::int64_t low, std::int64_t high);
/// `count` shapes in [0, size], some with a vertex, an edge, a plane or a T-junction in common with
/// the one before; at least one polygon.
void add_lattice(ScenePen& pen, Random& random, std::int64_t count, std::int64_t size);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_RANDOM_SHAPES_H
