// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes of programs whose y axis points upwards.
#ifndef GNOMON_SCENE_FILES_UP_AXIS_H
#define GNOMON_SCENE_FILES_UP_AXIS_H

#include "gnomon/scene/scene.h"

namespace gnomon {

/// Turns a scene with y up into one with z up: (x, y, z) becomes (x, -z, y), a quarter turn about
/// the x axis. Vertices, lights and their regions are turned. Exactness: exact.
void turn_y_up(Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_UP_AXIS_H
