// SPDX-License-Identifier: LGPL-3.0-or-later
// Preparation that is watched: a polygon of a million corners takes its time, and so do a million
// polygons.
#ifndef GNOMON_SCENE_PREPARE_CONTROL_H
#define GNOMON_SCENE_PREPARE_CONTROL_H

#include <atomic>
#include <functional>

#include "gnomon/scene/prepare.h"

namespace gnomon {

/// How a caller watches preparation, and stops it.
struct PrepareControl {
  const std::atomic<bool>* interrupted = nullptr;  // looked at within polygons, too
  /// Takes the fraction of the work done, 0..1, on any thread, several at a time. May be empty.
  std::function<void(double)> progress;
};

/// As prepare(scene). Errors: kInterrupted besides.
Expected<PreparedScene> prepare(const Scene& scene, const PrepareControl& control);

}  // namespace gnomon

#endif  // GNOMON_SCENE_PREPARE_CONTROL_H
