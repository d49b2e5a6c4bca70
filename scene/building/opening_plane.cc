// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/building/opening_plane.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

namespace {

std::array<mpq_class, 3> exact(const Position& position) {
  return {position[0].exact(), position[1].exact(), position[2].exact()};
}

}  // namespace

OpeningPlane::OpeningPlane(const std::vector<Position>& loop) {
  if (loop.empty()) return;
  origin_ = exact(loop[0]);
  // Newell's sum, from the first vertex, so that numbers stay short.
  std::array<mpq_class, 3> before;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    std::array<mpq_class, 3> here = exact(loop[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) here[axis] -= origin_[axis];
    for (std::size_t x = 0; x < 3; ++x) {
      const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
      normal_[x] += before[y] * here[z] - before[z] * here[y];
    }
    before = std::move(here);
  }
}

double OpeningPlane::distance(const std::vector<Position>& corners) const {
  const mpq_class square =
      normal_[0] * normal_[0] + normal_[1] * normal_[1] + normal_[2] * normal_[2];
  if (square == 0) return 0;
  mpq_class greatest;
  for (const Position& corner : corners) {
    const std::array<mpq_class, 3> at = exact(corner);
    mpq_class height;
    for (std::size_t axis = 0; axis < 3; ++axis)
      height += normal_[axis] * (at[axis] - origin_[axis]);
    greatest = std::max(greatest, mpq_class(abs(height)));
  }
  // Of the square of the distance, which is in the range of doubles where its parts are not.
  return std::sqrt(mpq_class(greatest * greatest / square).get_d());
}

}  // namespace gnomon
