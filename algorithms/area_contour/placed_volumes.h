// SPDX-License-Identifier: LGPL-3.0-or-later
// Many volumes on one receiver: where each may be, the largest outlines first, and which of them
// lie where those before cover.
//
// Guarantee: a volume that is left out adds nothing to what has been added before it.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_PLACED_VOLUMES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_PLACED_VOLUMES_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/area_contour/cover_mask.h"
#include "algorithms/area_contour/largest_first.h"
#include "algorithms/area_contour/receiver_chart.h"
#include "algorithms/area_contour/shadow_boxes.h"
#include "algorithms/area_contour/volume_search.h"

namespace gnomon::area_contour {

struct PlacedVolume {
  FoundVolume found;
  ShadowBoxes boxes;  // on the receiver's rectangle
};

class PlacedVolumes {
 public:
  /// `n`, `d`: of the receiver's plane, the light in front.
  void begin(const ReceiverChart& receiver, const Point3& n, double d, const LightVolumes& light);
  /// Puts a volume of the caster with those corners down, unless it certainly misses the receiver.
  /// `umbra_alone`: nor if its umbra does.
  void place(const FoundVolume& found, std::span<const Point3> caster, bool umbra_alone);
  const PlacedVolume& operator[](std::uint32_t number) const { return volumes_[number]; }
  /// The numbers of all that are placed.
  std::span<const std::uint32_t> largest_first();

  /// What the outlines that were added cover.
  CoverMask penumbras, umbras;

 private:
  static constexpr double kSmall = 256;  // of the receiver's rectangle
  ShadowProjection projection_;
  std::vector<PlacedVolume> volumes_;
  LargestFirst order_;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_PLACED_VOLUMES_H
