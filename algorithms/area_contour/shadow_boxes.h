// SPDX-License-Identifier: LGPL-3.0-or-later
// Where a caster's penumbra and umbra are on a receiver, as rectangles of its chart, before volumes
// are asked: the caster's corners seen from those of the light, on the receiver's plane.
//
// From a light's corner a that is farther from the plane than a caster's corner o, by their heights
// h, o is seen at o + t (o - a), t = h(o) / (h(a) - h(o)). For one a that keeps hulls, and for one
// o it does, too, so that the penumbra is in the hull of all these points, and the umbra in the
// hull from each a. That holds of casters that cross the plane as well: what is behind it only
// widens.
//
// Guarantee: rectangles hold what they are of.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_SHADOW_BOXES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_SHADOW_BOXES_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/area_contour/cover_mask.h"
#include "algorithms/area_contour/receiver_chart.h"

namespace gnomon::area_contour {

struct ShadowBoxes {
  ChartBox penumbra = ChartBox::everything(), umbra = ChartBox::everything();
  enum class Place : std::uint8_t { kBehind, kInFront, kUnknown };
  Place place = Place::kUnknown;  // kInFront: some of it certainly is
};

/// Of one receiver whose plane does not cut the light.
class ShadowProjection {
 public:
  /// `n`, `d`: of the receiver's plane, the light in front of it, where n . x - d is off by at most
  /// `error` for corners. `extra`: by so much are boxes to be wider.
  void begin(const ReceiverChart& receiver, const Point3& n, double d, double error,
             std::span<const Point3> light, double extra);
  /// Of the caster with those corners. Everything where doubles say too little.
  ShadowBoxes boxes(std::span<const Point3> caster) const;

 private:
  struct alignas(32) Seen {
    double u[4], v[4], height[4];
  };
  Point3 n_{}, origin_{};
  double d_ = 0, error_ = 0, extra_ = 0;
  std::size_t u_ = 0, v_ = 1;
  std::vector<Seen> light_;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_SHADOW_BOXES_H
