// SPDX-License-Identifier: GPL-3.0-or-later
// Families of scenes along one axis of difficulty each, from easy to hopeless for any kernel that
// rounds: step by step one quantity doubles, halves or grows by one, and all else stays.
//
// Coordinates are doubles, taken as exact, but for the axis "bits". Where a quantity leaves no room
// for the others (an offset of 2^60 for details of size 1), they are rounded to the doubles there
// are, as in any file; the exact answer is that of the rounded scene.
#ifndef GNOMON_COMPARISON_EXTREME_SCENES_H
#define GNOMON_COMPARISON_EXTREME_SCENES_H

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon::comparison {

struct ExtremeAxis {
  std::string_view name;     // such as "offset"
  std::string_view summary;  // what a step changes
  std::string_view value;    // of step k, such as "2^k"
  int first = 0, last = 0;   // steps
  int stride = 1;            // between the steps that are tried if nobody says otherwise
  Scene (*make)(int step) = nullptr;
  bool shears = true;  // else it has no sheared form, and is what it is
};

/// All axes there are.
std::span<const ExtremeAxis> extreme_axes();
/// Null: there is no such axis.
const ExtremeAxis* axis_by_name(std::string_view name);

/// The scene of a step. Sheared: under one exact map of space that keeps no plane parallel to an
/// axis, since planes that are friendly to rounding hide most of what it does. Requires: a step of
/// the axis.
Scene extreme_scene(const ExtremeAxis& axis, int step, bool sheared);

/// Maps a scene so: x + z / 8, y + x / 4, z + y / 16, in doubles, which is exact if coordinates are
/// short enough. Shadows and shares stay what they are.
void shear(Scene& scene);

/// "extreme:AXIS:STEP" or "extreme:AXIS:STEP:sheared", by which SceneSource::parse() makes it.
std::string extreme_name(const ExtremeAxis& axis, int step, bool sheared);
/// Errors: kUsage, for what begins with "extreme:" and is none.
Expected<Scene> extreme_by_name(std::string_view name);
inline constexpr std::string_view kExtremePrefix = "extreme:";

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_EXTREME_SCENES_H
