// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/shrink/coordinate_range.h"

#include <algorithm>

namespace gnomon::fuzz {

namespace {

/// Calls for every position, and for every direction.
template <class OnPosition, class OnDirection>
void for_each_point(const Scene& scene, const OnPosition& on_position,
                    const OnDirection& on_direction) {
  for (const Position& vertex : scene.vertices) on_position(vertex);
  for (const Light& light : scene.lights) {
    if (light.is_directional()) on_direction(light.position);
    if (light.is_point()) on_position(light.position);
    for (const Position& corner : light.loop) on_position(corner);
  }
}

}  // namespace

void CoordinateRange::Bounds::add(const Position& position) {
  for (std::size_t k = 0; k < position.size(); ++k) {
    low[k] = std::min(low[k], position[k].exact());
    high[k] = std::max(high[k], position[k].exact());
  }
}

bool CoordinateRange::Bounds::hold(const Position& position) const {
  for (std::size_t k = 0; k < position.size(); ++k) {
    const mpq_class value = position[k].exact();
    if (value < low[k] || value > high[k]) return false;
  }
  return true;
}

CoordinateRange::CoordinateRange(const Scene& scene) {
  directions_.low.fill(-1);
  directions_.high.fill(1);
  for_each_point(
      scene, [&](const Position& position) { positions_.add(position); },
      [&](const Position& direction) { directions_.add(direction); });
}

bool CoordinateRange::holds(const Scene& scene) const {
  bool all = true;
  for_each_point(
      scene, [&](const Position& position) { all = all && positions_.hold(position); },
      [&](const Position& direction) { all = all && directions_.hold(direction); });
  return all;
}

}  // namespace gnomon::fuzz
