// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/placed_volumes.h"

#include <algorithm>
#include <functional>

namespace gnomon::area_contour {

void PlacedVolumes::begin(const ReceiverChart& receiver, const Point3& n, double d,
                          const LightVolumes& light) {
  penumbras.begin(receiver);
  umbras = penumbras;
  projection_.begin(receiver, n, d, light.bound(), light.light_corners(), penumbras.margin());
  volumes_.clear();
}

void PlacedVolumes::place(const FoundVolume& found, std::span<const Point3> caster,
                          bool umbra_alone) {
  PlacedVolume volume{found, projection_.boxes(caster)};
  ShadowBoxes& boxes = volume.boxes;
  boxes.penumbra.clip(penumbras.box());
  boxes.umbra.clip(penumbras.box());
  volume.found.umbra = found.umbra && !boxes.umbra.is_empty();
  volume.found.penumbra = found.penumbra && !umbra_alone;
  if (boxes.place == ShadowBoxes::Place::kBehind || boxes.penumbra.is_empty() ||
      !(volume.found.umbra || volume.found.penumbra)) {
    return;
  }
  volumes_.push_back(volume);
}

/// Where outlines are so small that they hide little, neighbours in space stay neighbours: that is
/// how they lie in memory.
std::span<const PlacedVolume> PlacedVolumes::largest_first() {
  const auto area = [](const PlacedVolume& volume) {
    return (volume.found.penumbra ? volume.boxes.penumbra : volume.boxes.umbra).area();
  };
  const double least = penumbras.box().area() / kSmall;
  const auto small = std::ranges::stable_partition(
      volumes_, [&](const PlacedVolume& volume) { return area(volume) > least; });
  std::ranges::stable_sort(volumes_.begin(), small.begin(), std::greater{}, area);
  return volumes_;
}

}  // namespace gnomon::area_contour
