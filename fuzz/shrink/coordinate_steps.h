// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of shrinking that change coordinates: the whole scene, an axis, a value, a point, a number.
// All of them go through the integers of one grid and back.
#ifndef GNOMON_FUZZ_SHRINK_COORDINATE_STEPS_H
#define GNOMON_FUZZ_SHRINK_COORDINATE_STEPS_H

#include "fuzz/shrink/smallest_scene.h"

namespace gnomon::fuzz {

void change_scene(SmallestScene& search);
void change_axes(SmallestScene& search);
/// All places that hold one value of an axis change together: what is level stays level.
void change_values(SmallestScene& search);
void change_points(SmallestScene& search);
void change_coordinates(SmallestScene& search);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SHRINK_COORDINATE_STEPS_H
