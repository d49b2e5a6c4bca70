// SPDX-License-Identifier: GPL-3.0-or-later
// The three vertices that stand for a plane: well spread over all polygons that lie in it, the same
// for every way in which the scene may be written down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "builder.h"

namespace gnomon::test {
namespace {

/// On z = x + 2 y, exactly.
Triple on_slope(double x, double y) { return {x, y, x + 2 * y}; }

/// A quadrilateral that starts with three vertices all but on one line, and a large one.
Scene sliver_and_slope() {
  const double hair = std::ldexp(1, -53);
  Builder b;
  b.polygon({on_slope(1, 1), on_slope(0.5, 0.5 + hair), on_slope(0, 0), on_slope(1, 0)});
  b.polygon({on_slope(-8, -8), on_slope(8, -8), on_slope(8, 8), on_slope(-8, 8)});
  return b.scene();
}

std::array<VertexId, 3> triple_of(const Scene& scene) {
  const auto prepared = prepare(scene);
  EXPECT_TRUE(prepared);
  EXPECT_EQ(first_flaw(*prepared, scene), "");
  EXPECT_EQ(prepared->geometry.planes.size(), 1u);
  const SupportTriple& triple = prepared->geometry.planes.at(0);
  return {triple.a, triple.b, triple.c};
}

TEST(SupportPlane, IsOfTheWholeFamily) {
  // Vertices 4 to 7 are the large one's; 0 is always one of the three.
  const auto triple = triple_of(sliver_and_slope());
  EXPECT_EQ(triple[0], 0u);
  EXPECT_GE(triple[1], 4u);
  EXPECT_GE(triple[2], 4u);
}

TEST(SupportPlane, DependsNeitherOnOrderNorOnWhereLoopsStart) {
  Scene scene = sliver_and_slope();
  const auto first = triple_of(scene);
  for (int swapped = 0; swapped < 2; ++swapped) {
    for (int turn = 0; turn < 4; ++turn) {
      EXPECT_EQ(triple_of(scene), first) << swapped << " " << turn;
      for (Polygon& polygon : scene.polygons) {
        std::rotate(polygon.loop.begin(), polygon.loop.begin() + 1, polygon.loop.end());
      }
    }
    std::swap(scene.polygons[0], scene.polygons[1]);
  }
}

TEST(SupportPlane, NorDoesItsOrientationDependOnTheOrder) {
  Scene scene = sliver_and_slope();
  std::reverse(scene.polygons[1].loop.begin(), scene.polygons[1].loop.end());
  const auto first = triple_of(scene);
  std::swap(scene.polygons[0], scene.polygons[1]);
  EXPECT_EQ(triple_of(scene), first);
}

TEST(SupportPlane, OfAPolygonWithManyParts) {
  // A comb: each part is narrow, and the whole is not.
  Builder b;
  std::vector<Triple> loop{on_slope(0, 0), on_slope(64, 0)};
  for (int i = 32; i-- > 0;) {
    loop.push_back(on_slope(2 * i + 1, 32));
    loop.push_back(on_slope(2 * i, 1));
  }
  b.polygon(loop);
  const auto prepared = b.prepare();
  ASSERT_TRUE(prepared);
  ASSERT_GT(prepared->parts.size(), 16u);
  const SupportTriple& triple = prepared->geometry.planes.at(0);
  const Exact3 normal =
      plain_cross(grid_point(*prepared, triple.a), grid_point(*prepared, triple.b),
                  grid_point(*prepared, triple.c));
  // Twice the area in the projection: that of a triangle over both extents, 64 by 32.
  EXPECT_GE(abs(normal[2]), 63 * 31);
}

}  // namespace
}  // namespace gnomon::test
