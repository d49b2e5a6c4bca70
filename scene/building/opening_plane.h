// SPDX-License-Identifier: LGPL-3.0-or-later
// How far windows and doors are from the plane of their wall. Many programs place them by doubles,
// or within a tolerance, and then they are a hair before or behind it.
#ifndef GNOMON_SCENE_BUILDING_OPENING_PLANE_H
#define GNOMON_SCENE_BUILDING_OPENING_PLANE_H

#include <gmpxx.h>

#include <array>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon {

/// The plane through the first vertex of a loop whose normal is the loop's area vector.
class OpeningPlane {
 public:
  explicit OpeningPlane(const std::vector<Position>& loop);
  /// The greatest distance of a corner, scene units: 0 exactly if all of them lie in the plane. 0
  /// also if the loop has no area.
  double distance(const std::vector<Position>& corners) const;

 private:
  std::array<mpq_class, 3> normal_, origin_;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_BUILDING_OPENING_PLANE_H
