// SPDX-License-Identifier: LGPL-3.0-or-later
// A shaft: the convex hull of a point and a light, between two planes. A hierarchy of casters
// (partition/box_tree.h) is asked for those that may reach into it.
//
// Guarantee: conservative. A box that misses() accepts is proven to miss the shaft (closed); one
// that it does not accept may still miss it. Boxes are in units of the unit cube of apex.h, rounded
// outwards.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_LIGHT_SHAFT_H
#define GNOMON_ALGORITHMS_ILLUMINATION_LIGHT_SHAFT_H

#include <array>
#include <vector>

#include "algorithms/partition/box.h"

namespace gnomon {

/// A box misses the shaft if it misses the shaft's own box, or lies in the back of one of the
/// planes by more than the plane's error.
struct LightShaft {
  struct Plane {
    std::array<double, 3> normal;
    double offset = 0;       // front: normal . x - offset >= 0
    double error_bound = 0;  // of that value, for points of the unit cube
  };
  Box box;
  std::vector<Plane> planes;

  bool misses(const Box& other) const {
    for (int k = 0; k < 3; ++k) {
      if (other.low[k] > box.high[k] || other.high[k] < box.low[k]) return true;
    }
    for (const Plane& plane : planes) {
      double largest = -plane.offset;
      for (int k = 0; k < 3; ++k) {
        largest += plane.normal[k] * (plane.normal[k] > 0 ? other.high[k] : other.low[k]);
      }
      if (largest < -plane.error_bound) return true;
    }
    return false;
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_LIGHT_SHAFT_H
