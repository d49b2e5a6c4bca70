// SPDX-License-Identifier: LGPL-3.0-or-later
// A bounding-volume hierarchy of casters, asked for those that may reach into a shaft: the convex
// hull of a point and a light, between two planes.
//
// Guarantee: conservative. What is left out is proven to miss the shaft (closed); what is returned
// may still miss it. Boxes are in units of the unit cube of apex.h, rounded outwards.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_SHAFT_TREE_H
#define GNOMON_ALGORITHMS_ILLUMINATION_SHAFT_TREE_H

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon {

struct ShaftBox {
  std::array<double, 3> low, high;
};

/// A box misses the shaft if it misses the shaft's own box, or lies in the back of one of the
/// planes by more than the plane's error.
struct LightShaft {
  struct Plane {
    std::array<double, 3> normal;
    double offset = 0;       // front: normal . x - offset >= 0
    double error_bound = 0;  // of that value, for points of the unit cube
  };
  ShaftBox box;
  std::vector<Plane> planes;

  bool misses(const ShaftBox& other) const {
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

class ShaftTree {
 public:
  ShaftTree() = default;
  /// Box i is caster i. Cost: O(n log n).
  explicit ShaftTree(std::vector<ShaftBox> boxes);

  /// Appends the casters whose boxes may reach into the shaft, in no particular order.
  const ShaftBox& box(std::uint32_t caster) const { return boxes_[caster]; }
  void find(const LightShaft& shaft, std::vector<std::uint32_t>& found) const;

 private:
  static constexpr std::uint32_t kLeafSize = 4;
  struct Node {
    ShaftBox box;
    std::uint32_t first = 0, count = 0;  // a leaf's casters in order_; count 0: an inner node whose
                                         // children are the next node and `first`
  };
  std::vector<ShaftBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_SHAFT_TREE_H
