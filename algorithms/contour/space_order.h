// SPDX-License-Identifier: LGPL-3.0-or-later
// A prepared scene in another order: parts along a space-filling curve, and vertices, edges and
// planes as those parts name them, so that what is near in the scene is near in memory.
//
// Files name polygons in any order, often a shuffled one. Made once for all lights of a run.
//
// Guarantee: the same scene; only indices differ, and the direction of edges (from the smaller
// vertex). Positions of lights stay where they are.
#ifndef GNOMON_ALGORITHMS_CONTOUR_SPACE_ORDER_H
#define GNOMON_ALGORITHMS_CONTOUR_SPACE_ORDER_H

#include <cstdint>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

class SpaceOrder {
 public:
  /// Whether the scene is so large that the caches do not hold it in any order. A run that has a
  /// sun most often has many of them, for which the order is made once; so it pays sooner for them.
  /// It must not depend on how many there are, since an order changes the last bits of bounds.
  static bool pays(const PreparedScene& scene, bool directional);

  /// With `jobs` other than 1 on the threads of the caller's arena; the same for every number.
  explicit SpaceOrder(const PreparedScene& scene, unsigned jobs = 1);

  /// The scene in the new order, as far as point lights need it: without notes, and first_part is
  /// empty, since the parts of a polygon need not follow each other.
  const PreparedScene& scene() const { return scene_; }
  /// Puts the parts of a result of scene() into the order of the original.
  void restore(LightResult& result) const;

 private:
  PreparedScene scene_;
  std::vector<std::uint32_t> parts_;  // the original index of each part
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_SPACE_ORDER_H
