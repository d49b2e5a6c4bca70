// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/placed_volumes.h"

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
std::span<const std::uint32_t> PlacedVolumes::largest_first() {
  const double least = penumbras.box().area() / kSmall;
  order_.clear();
  for (const auto& [found, boxes] : volumes_) {
    const double area = (found.penumbra ? boxes.penumbra : boxes.umbra).area();
    order_.add(area > least ? static_cast<float>(area) : 0);
  }
  return order_.sorted();
}

}  // namespace gnomon::area_contour
