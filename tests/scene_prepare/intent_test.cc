// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene perhaps does not mean is found, and what is exactly as it should be is not.
#include "gnomon/scene/intent.h"

#include <gmock/gmock.h>

#include <cmath>

#include "builder.h"
#include "gnomon/scene/generate.h"

namespace gnomon::test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

using Loop = std::vector<Triple>;

Intent intent_of(const Builder& builder, Scene& scene, double near = 0) {
  const auto prepared = builder.prepare();
  EXPECT_TRUE(prepared) << to_string(prepared.error());
  return find_intent(scene, *prepared, {.near = near});
}

/// A square in the plane z = height, its corner at (x, y).
Loop square(double x, double y, double size, double height) {
  return {
      {x, y, height}, {x + size, y, height}, {x + size, y + size, height}, {x, y + size, height}};
}

/// The six faces of a box with shared corners, looking outwards.
void add_box(Scene& scene, const Triple& low, const Triple& high, bool inwards = false) {
  const auto first = static_cast<VertexId>(scene.vertices.size());
  for (unsigned corner = 0; corner < 8; ++corner) {
    scene.vertices.push_back(
        position({(corner & 1) != 0 ? high[0] : low[0], (corner & 2) != 0 ? high[1] : low[1],
                  (corner & 4) != 0 ? high[2] : low[2]}));
  }
  for (const std::array<VertexId, 4> face : {std::array<VertexId, 4>{0, 2, 3, 1},
                                             {4, 5, 7, 6},
                                             {0, 1, 5, 4},
                                             {2, 6, 7, 3},
                                             {0, 4, 6, 2},
                                             {1, 3, 7, 5}}) {
    Polygon polygon;
    polygon.id = std::to_string(scene.polygons.size());
    for (const VertexId corner : face) polygon.loop.push_back(first + corner);
    if (inwards) std::reverse(polygon.loop.begin(), polygon.loop.end());
    scene.polygons.push_back(polygon);
  }
}

TEST(Intent, NearlyCoplanarPairs) {
  Builder b;
  b.polygon(square(0, 0, 10, 0)).polygon(square(2, 2, 3, 1e-6)).polygon(square(6, 6, 3, 0));
  b.polygon(square(10, 0, 10, 1e-6));  // beside it
  b.polygon(square(2, 2, 3, 5));
  const Intent intent = intent_of(b, b.scene());
  ASSERT_THAT(intent.nearly_coplanar, SizeIs(1));
  const NearlyCoplanarPair& pair = intent.nearly_coplanar[0];
  EXPECT_EQ(pair.polygon, 1u);
  EXPECT_EQ(pair.other, 0u);
  EXPECT_THAT(pair.distance, DoubleNear(1e-6, 1e-12));
  EXPECT_THAT(pair.overlap, DoubleNear(9, 1e-9));
  EXPECT_EQ(pair.angle, 0);
  EXPECT_TRUE(intent.is_doubtful());
  EXPECT_THAT(intent_of(b, b.scene(), 1e-7).nearly_coplanar, IsEmpty());
}

TEST(Intent, TiltedPairs) {
  Builder b;
  b.polygon({{0, 0, 0}, {10, 0, 0}, {10, 10, 10}, {0, 10, 10}});
  b.polygon({{2, 2, 2}, {5, 2, 2}, {5, 5, 5.00001}, {2, 5, 5.00001}});
  const Intent intent = intent_of(b, b.scene());
  ASSERT_THAT(intent.nearly_coplanar, SizeIs(1));
  EXPECT_THAT(intent.nearly_coplanar[0].distance, DoubleNear(1e-5 / std::sqrt(2), 1e-9));
  EXPECT_GT(intent.nearly_coplanar[0].angle, 0);
}

TEST(Intent, NearlySharedVerticesAndEdges) {
  Builder b;
  b.polygon(square(0, 0, 1, 0)).polygon(square(1 + 1e-7, 0, 1, 0));
  Intent intent = intent_of(b, b.scene());
  EXPECT_THAT(intent.near_vertices, SizeIs(2));
  EXPECT_THAT(intent.near_edges, SizeIs(1));
  Builder exact;
  exact.polygon(square(0, 0, 1, 0)).polygon(square(1, 0, 1, 0));
  intent = intent_of(exact, exact.scene());
  EXPECT_THAT(intent.near_vertices, IsEmpty());
  EXPECT_THAT(intent.near_edges, IsEmpty());
  EXPECT_FALSE(intent.is_doubtful());
}

TEST(Intent, BentPolygons) {
  Builder b;
  b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-9}, {0, 1, 0}});
  b.polygon({{0, 0, 5}, {1, 0, 5}, {1, 1, 6}, {0, 1, 5}});  // on purpose
  const Intent intent = intent_of(b, b.scene());
  ASSERT_THAT(intent.bent, SizeIs(1));
  EXPECT_EQ(intent.bent[0].polygon, 0u);
  EXPECT_THAT(intent.bent[0].distance, DoubleNear(2.5e-10, 3e-10));
}

TEST(Intent, ClosedComponents) {
  Builder b;
  add_box(b.scene(), {0, 0, 0}, {1, 1, 1});
  add_box(b.scene(), {5, 0, 0}, {6, 1, 1}, true);
  add_box(b.scene(), {10, 0, 0}, {14, 4, 4});
  add_box(b.scene(), {11, 1, 1}, {12, 2, 2}, true);
  add_box(b.scene(), {20, 0, 0}, {21, 1, 1});
  std::swap(b.scene().polygons[24].loop[1], b.scene().polygons[24].loop[3]);
  b.polygon(square(30, 0, 1, 0));
  b.point_light({0.5, 0.5, 0.5}).sun({0, 0, 1});
  const Intent intent = intent_of(b, b.scene());
  std::vector<ComponentOrientation> looks;
  for (const ClosedComponent& component : intent.closed) {
    looks.push_back(component.orientation);
    EXPECT_THAT(component.polygons, SizeIs(6));
  }
  EXPECT_THAT(looks, ElementsAre(ComponentOrientation::kOutwards, ComponentOrientation::kInwards,
                                 ComponentOrientation::kOutwards, ComponentOrientation::kInwards,
                                 ComponentOrientation::kMixed));
  EXPECT_THAT(intent.closed[0].lights_inside, ElementsAre(0));
  EXPECT_TRUE(intent.is_seen_through(intent.closed[0]));
  EXPECT_TRUE(intent.is_inside_out(intent.closed[1]));
  EXPECT_FALSE(intent.is_inside_out(intent.closed[3]));
  EXPECT_TRUE(intent.closed[3].is_cavity);
}

TEST(Intent, SheetsOfTwoPolygonsAreFlat) {
  Builder b;
  b.polygon(square(0, 0, 1, 0));
  Polygon back = b.scene().polygons[0];
  back.id = "back";
  std::reverse(back.loop.begin(), back.loop.end());
  b.scene().polygons.push_back(back);
  const Intent intent = intent_of(b, b.scene());
  ASSERT_THAT(intent.closed, SizeIs(1));
  EXPECT_EQ(intent.closed[0].orientation, ComponentOrientation::kFlat);
  EXPECT_FALSE(intent.is_doubtful());
}

TEST(Intent, FacingNothing) {
  Builder b;
  Loop down = square(2, 2, 2, 3);
  std::reverse(down.begin(), down.end());
  b.polygon(square(0, 0, 10, 0)).polygon(down).sun({0, 0, 1});
  Intent intent = intent_of(b, b.scene());
  EXPECT_THAT(intent.facing_nothing, ElementsAre(1));
  b.scene().polygons[1].two_sided = true;
  EXPECT_THAT(intent_of(b, b.scene()).facing_nothing, IsEmpty());
  b.scene().polygons[1].two_sided.reset();
  b.point_light({3, 3, 1});
  EXPECT_THAT(intent_of(b, b.scene()).facing_nothing, IsEmpty());
  // A window in a wall that looks away.
  Builder wall;
  wall.polygon({{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}})
      .polygon({{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 0, 1}});
  wall.sun({0, -1, 1});
  EXPECT_THAT(intent_of(wall, wall.scene()).facing_nothing, IsEmpty());
}

TEST(Intent, FarFromTheOrigin) {
  Builder b;
  b.polygon(square(5e6, 0, 1, 0));
  EXPECT_TRUE(intent_of(b, b.scene()).is_far_from_origin());
  Builder near;
  near.polygon(square(50, 0, 1, 0));
  EXPECT_FALSE(intent_of(near, near.scene()).is_far_from_origin());
  // Pairs are found there too.
  Builder pair;
  pair.polygon(square(4194304, 0, 8, 0)).polygon(square(4194305, 1, 2, 0x1p-30));
  EXPECT_THAT(intent_of(pair, pair.scene()).nearly_coplanar, SizeIs(1));
}

TEST(Intent, LargeScenesInPart) {
  Builder b;
  b.polygon(square(0, 0, 10, 0)).polygon(square(2, 2, 3, 1e-6));
  const auto prepared = b.prepare();
  const Intent intent = find_intent(b.scene(), *prepared, {.near = 0, .most_parts = 1});
  EXPECT_TRUE(intent.is_partial);
  EXPECT_THAT(intent.nearly_coplanar, IsEmpty());
}

TEST(Intent, EmptyScene) {
  Builder b;
  EXPECT_FALSE(intent_of(b, b.scene()).is_doubtful());
}

}  // namespace
}  // namespace gnomon::test
