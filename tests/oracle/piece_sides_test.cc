// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "oracle/geometry/group_overlay.h"
#include "oracle/judge/witness_pieces.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

/// A point of the plane z = x / 8 + y / 4.
RationalPoint on_plane(const mpq_class& x, const mpq_class& y) {
  return {x, y, mpq_class(x / 8 + y / 4)};
}

/// Triangles with an edge so short that its direction in the frame is mostly noise.
space::Loop triangle_with_short_edge(Random& random) {
  const auto coordinate = [&] { return mpq_class(random.integer(0, 80), 7); };
  const auto hair = [&] {
    mpq_class own(random.integer(-9, 9));
    mpq_div_2exp(own.get_mpq_t(), own.get_mpq_t(), static_cast<unsigned>(random.integer(0, 70)));
    return own;
  };
  const mpq_class x = coordinate(), y = coordinate();
  return {on_plane(x, y), on_plane(x + hair(), y + hair()), on_plane(coordinate(), coordinate())};
}

struct Common {
  bool area = false;     // of what both have
  bool all_of_b = true;  // no vertex of b is outside of a
};

Common common_of(Piece& a, const Piece& b, const RationalPoint& normal) {
  Common common;
  space::Loop rest = b.loop;
  for (const space::HalfSpace& wall : a.walls_of(normal)) {
    for (const RationalPoint& point : b.loop) {
      common.all_of_b = common.all_of_b && wall.value(point) >= 0;
    }
    if (!rest.empty()) rest = space::cut(rest, wall);
  }
  common.area = !rest.empty() && space::area_along(normal, rest) > 0;
  return common;
}

TEST(PieceSides, AreExactWhateverTheLengthOfAnEdge) {
  const BuiltScene built = SceneBuilder()
                               .polygon("r", {{0, 0, 0}, {16, 0, 2}, {16, 16, 6}, {0, 16, 4}})
                               .sun("s", {0, 0, 1})
                               .build();
  const RationalPoint normal = solid_of(built.prepared, 0).normal;
  const PlaneFrame frame(built.prepared.geometry, grid_loop(built.prepared, 0));
  const PieceSides sides(normal, 16);
  Random random(1);
  int apart = 0, inside = 0;
  constexpr int kPairs = 20'000;
  for (int i = 0; i < kPairs; ++i) {
    space::Loop first = triangle_with_short_edge(random), second = triangle_with_short_edge(random);
    // Many share a vertex, or lie in each other.
    if (i % 3 == 0) second[random.integer(0, 2)] = first[random.integer(0, 2)];
    if (i % 5 == 0) {
      for (RationalPoint& point : second) {
        for (int k = 0; k < 3; ++k) point[k] = (point[k] + 99 * first[0][k]) / 100;
      }
    }
    Piece a(0, first, normal), b(0, second, normal);
    if (a.area == 0 || b.area == 0) continue;
    a.lay(frame);
    b.lay(frame);
    const Common common = common_of(a, b, normal);
    EXPECT_EQ(sides.are_apart(a, b) || sides.are_apart(b, a), !common.area) << i;
    EXPECT_EQ(sides.holds(a, b), common.all_of_b) << i;
    apart += !common.area;
    inside += common.all_of_b;
  }
  EXPECT_GT(apart, kPairs / 20);
  EXPECT_GT(inside, 10);
}

TEST(Piece, IsConvexOnlyIfItGoesAroundOnce) {
  const RationalPoint up{0, 0, 1};
  const auto is_convex = [&](const std::vector<std::array<int, 2>>& corners) {
    space::Loop loop;
    for (const auto& [x, y] : corners) loop.push_back({x, y, 0});
    return Piece(0, loop, up).is_convex(up);
  };
  EXPECT_TRUE(is_convex({{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
  EXPECT_TRUE(is_convex({{0, 0}, {0, 4}, {4, 4}, {4, 0}}));
  EXPECT_TRUE(is_convex({{0, 0}, {2, 0}, {4, 0}, {4, 4}}));
  EXPECT_TRUE(is_convex({{0, 0}, {2, 0}, {2, 0}, {4, 4}}));
  EXPECT_FALSE(is_convex({{0, 0}, {4, 0}, {4, 4}, {3, 1}}));
  EXPECT_FALSE(is_convex({{0, 0}, {5, 0}, {4, 0}, {4, 4}}));
  // Never turns right, and goes around twice.
  EXPECT_FALSE(is_convex({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, -1}, {5, -1}, {5, 5}, {-1, 5}}));
  EXPECT_FALSE(is_convex({{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}}));
}

}  // namespace
}  // namespace gnomon::oracle
