// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of shrinking that change no coordinate: they drop, reset and join.
#ifndef GNOMON_FUZZ_SHRINK_STRUCTURE_STEPS_H
#define GNOMON_FUZZ_SHRINK_STRUCTURE_STEPS_H

#include "fuzz/shrink/smallest_scene.h"

namespace gnomon::fuzz {

/// Tries the scenes before the moves that made this one (ShrinkOptions::simpler).
void undo_moves(SmallestScene& search);
void tidy_up(SmallestScene& search);
void drop_polygons(SmallestScene& search);
void drop_lights(SmallestScene& search);
void drop_holes(SmallestScene& search);
void drop_corners(SmallestScene& search);
void reset_flags(SmallestScene& search);
/// A vertex takes the place of another, and is it from then on.
void join_vertices(SmallestScene& search);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SHRINK_STRUCTURE_STEPS_H
