// SPDX-License-Identifier: GPL-3.0-or-later
// The plane of an area light as kernels are given it: through corners that are far apart, the same
// wherever the light's loop begins.
#include "algorithms/shadow_volumes/light_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "solve.h"

namespace gnomon::test {
namespace {

Position at(double x, double y, double z) { return {Number(x), Number(y), Number(z)}; }

/// A tilted panel whose corners are cut off by a hair, so that some three in a row are a sliver.
Scene scene_with_panel(std::size_t begin) {
  Scene scene;
  scene.vertices = {at(-8, -8, 0), at(8, -8, 0), at(8, 8, 0), at(-8, 8, 0)};
  Polygon floor;
  floor.id = "floor";
  floor.loop = {0, 1, 2, 3};
  scene.polygons.push_back(floor);
  Light panel;
  panel.id = "panel";
  panel.type = LightType::kArea;
  constexpr double kHair = 0x1p-20;
  // z = 5 + x / 2, clockwise from above: it shines down.
  const std::array<std::array<double, 2>, 6> corners{
      {{0, 0}, {0, 4}, {4 - kHair, 4}, {4, 4 - kHair}, {4, kHair}, {4 - kHair, 0}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& [x, y] = corners[(begin + i) % corners.size()];
    panel.loop.push_back(at(x, y, 5 + x / 2));
  }
  scene.lights.push_back(panel);
  return scene;
}

std::set<std::array<double, 3>> plane_corners(const Scene& scene) {
  const auto prepared = Case::make(scene);
  EXPECT_TRUE(prepared);
  const LightGeometry geometry = make_light_geometry(prepared->prepared());
  const LightFace& face = geometry.faces[0];
  const SupportTriple& triple = geometry.geometry.planes[face.plane];
  const auto& positions = geometry.geometry.positions;
  return {positions[triple.a], positions[triple.b], positions[triple.c]};
}

TEST(LightGeometry, PlaneIsThroughCornersFarApartWhereverTheLoopBegins) {
  const auto corners = plane_corners(scene_with_panel(0));
  ASSERT_EQ(corners.size(), 3u);
  for (const auto& a : corners) {
    for (const auto& b : corners) {
      if (a == b) continue;
      EXPECT_GT(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]), 3);
    }
  }
  for (std::size_t begin = 1; begin < 6; ++begin) {
    EXPECT_EQ(plane_corners(scene_with_panel(begin)), corners) << begin;
  }
}

}  // namespace
}  // namespace gnomon::test
