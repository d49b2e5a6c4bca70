// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons that are convex and planar as they stand: welding, edges, families, the grid.
#include <gtest/gtest.h>

#include <cmath>

#include "builder.h"

namespace gnomon::test {
namespace {

TEST(Convex, PassesThrough) {
  Builder b;
  b.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}).point_light({1, 1, 3});
  const auto prepared = b.prepare();
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_EQ(first_flaw(*prepared, b.scene()), "");
  ASSERT_EQ(prepared->parts.size(), 1u);
  EXPECT_EQ(prepared->loop_vertices, (std::vector<VertexId>{0, 1, 2, 3}));
  EXPECT_TRUE(prepared->notes.empty());
  EXPECT_EQ(prepared->geometry.edges.size(), 4u);
  EXPECT_EQ(prepared->geometry.step, 1);
  EXPECT_EQ(prepared->position_bits, 3u);
}

TEST(Convex, SharesVerticesEdgesAndPlanes) {
  // Two squares side by side, with vertices of their own, and the second seen from below.
  Builder b;
  b.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  b.polygon({{2, 0, 0}, {2, 2, 0}, {4, 2, 0}, {4, 0, 0}});
  b.polygon({{0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}});
  const auto prepared = b.prepare();
  ASSERT_TRUE(prepared);
  EXPECT_EQ(first_flaw(*prepared, b.scene()), "");
  EXPECT_EQ(prepared->geometry.positions.size(), 10u);
  EXPECT_EQ(prepared->geometry.edges.size(), 11u);
  EXPECT_EQ(prepared->geometry.planes.size(), 2u);
  EXPECT_EQ(prepared->parts[0].plane, prepared->parts[1].plane);
  EXPECT_NE(prepared->parts[0].flipped, prepared->parts[1].flipped);
  EXPECT_EQ(prepared->geometry.step, 2);  // the grid takes the greatest common step
  EXPECT_EQ(prepared->position_bits, 2u);
}

TEST(Convex, NearlyEqualPlanesStayApart) {
  const double tiny = std::ldexp(1.0, -40);
  Builder b;
  b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  b.polygon({{2, 0, tiny}, {3, 0, tiny}, {3, 1, tiny}, {2, 1, tiny}});
  b.polygon({{4, 0, 0}, {5, 0, tiny}, {5, 1, tiny}, {4, 1, 0}});
  const auto prepared = b.prepare();
  ASSERT_TRUE(prepared);
  EXPECT_EQ(first_flaw(*prepared, b.scene()), "");
  EXPECT_EQ(prepared->geometry.planes.size(), 3u);
}

TEST(Convex, StarIsNotConvexThoughItOnlyTurnsLeft) {
  Builder b;
  b.polygon({{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}});
  const auto prepared = b.prepare();
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().code, ErrorCode::kGeometry);
  EXPECT_EQ(prepared.error().where.pointer, "/polygons/0/loop");
}

TEST(Grid, DecimalsNeedFewerBitsThanDoubles) {
  // A building of 80 m in millimetres: 17 bits as decimals, far more as doubles.
  const std::vector<std::array<long, 3>> corners = {
      {0, 0, 0}, {80123, 0, 0}, {80123, 12345, 0}, {0, 12345, 0}};
  Scene decimal;
  Scene doubles;
  decimal.numbers = NumberMeaning::kDecimal;
  for (const auto& c : corners) {
    decimal.vertices.push_back({milli(c[0]), milli(c[1]), milli(c[2])});
    doubles.vertices.push_back(
        position({static_cast<double>(c[0]) / 1000, static_cast<double>(c[1]) / 1000,
                  static_cast<double>(c[2]) / 1000}));
  }
  Polygon floor;
  floor.id = "floor";
  floor.loop = {0, 1, 2, 3};
  decimal.polygons = doubles.polygons = {floor};
  const auto a = prepare(decimal);
  const auto b = prepare(doubles);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->position_bits, 17u);
  EXPECT_EQ(a->geometry.step, mpq_class(1, 1000));
  EXPECT_GE(b->position_bits, 50u);
  EXPECT_EQ(first_flaw(*a, decimal), "");
  EXPECT_EQ(first_flaw(*b, doubles), "");
}

TEST(Grid, MixedMagnitudes) {
  Builder b;
  b.polygon({{0, 0, 0}, {1e308, 0, 0}, {1e308, 1e-308, 0}, {0, 1e-308, 0}});
  b.polygon({{0, 0, 5e-324}, {1, 0, 5e-324}, {1, 1, 5e-324}});
  b.point_light({1e-300, 1, -1e308});
  const auto prepared = b.prepare();
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_EQ(first_flaw(*prepared, b.scene()), "");
  EXPECT_GT(prepared->position_bits, 2000u);
  EXPECT_EQ(prepared->geometry.planes.size(), 2u);
}

TEST(Grid, MixedBases) {
  Scene scene;
  scene.vertices = {{Number::from_decimal(1, -1), Number(0.5), Number(0.0)},
                    {Number::from_decimal(7, 2), Number(0.5), Number(0.0)},
                    {Number::from_decimal(7, 2), Number(96.0), Number(0.0)}};
  Polygon p;
  p.id = "p";
  p.loop = {0, 1, 2};
  scene.polygons = {p};
  const auto prepared = prepare(scene);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(first_flaw(*prepared, scene), "");
}

TEST(Lights, DirectionsArePrimitive) {
  Builder b;
  b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}).sun({0.75, -1.5, 6}).sun({0, 0, 1e300});
  const auto prepared = b.prepare();
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->lights[0].point.grid, (std::array<mpz_class, 3>{1, -2, 8}));
  EXPECT_EQ(prepared->lights[1].point.grid, (std::array<mpz_class, 3>{0, 0, 1}));
  EXPECT_EQ(prepared->direction_bits, 4u);
  Builder zero;
  zero.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}).sun({0, 0, 0});
  const auto failed = zero.prepare();
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().where.pointer, "/lights/0/to_light");
}

TEST(Lights, PointLightsCountForTheGrid) {
  Builder b;
  b.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}).point_light({-0.5, 1, 1e6});
  const auto prepared = b.prepare();
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->geometry.step, mpq_class(1, 2));
  // The lamp is so far away that the grid starts at the vertices, and has their bits alone.
  EXPECT_EQ(prepared->lights[0].point.grid, (std::array<mpz_class, 3>{-1, 2, 2000000}));
  EXPECT_EQ(prepared->geometry.grid.bits(), 4u);
  EXPECT_EQ(prepared->position_bits, 21u);
  EXPECT_EQ(first_flaw(*prepared, b.scene()), "");
}

}  // namespace
}  // namespace gnomon::test
