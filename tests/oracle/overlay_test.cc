// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/overlay.h"

#include <gtest/gtest.h>

#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

ChartPoint p(int x, int y) { return {x, y, 1}; }
std::vector<ChartPoint> square(int x, int y, int size) {
  return {p(x, y), p(x + size, y), p(x + size, y + size), p(x, y + size)};
}

mpq_class area_where(const Overlay& overlay, bool (*choice)(const Winding&)) {
  std::vector<bool> faces;
  for (const Overlay::Face& face : overlay.faces()) faces.push_back(choice(face.winding));
  faces[0] = false;
  const mpq_class exact = overlay.exact_area(faces);
  return exact;
}

TEST(Overlay, EmptyHasOneFace) {
  Overlay overlay;
  overlay.build();
  EXPECT_TRUE(overlay.consistent());
  EXPECT_EQ(overlay.faces().size(), 1u);
}

TEST(Overlay, SharedEdgesOfOneLayerVanish) {
  Overlay overlay;
  overlay.add_loop(square(0, 0, 2), kLit);
  overlay.add_loop(square(2, 0, 2), kLit);
  overlay.build();
  EXPECT_TRUE(overlay.consistent());
  EXPECT_EQ(overlay.faces().size(), 2u);
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w[kLit] == 1; }), 8);
}

TEST(Overlay, MarkedLoopsAreToldApart) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    Overlay overlay;
    overlay.add_loop(square(-1, -1, 20), kReceiver);
    struct Square {
      int x, y, size;
    };
    std::vector<Square> squares;
    for (std::uint32_t mark = 0; mark < 12; ++mark) {
      // Small coordinates: many edges lie on each other, and cancel in one layer.
      squares.push_back({random.integer(0, 6), random.integer(0, 6), random.integer(1, 4)});
      const std::vector<ChartPoint> loop =
          square(squares[mark].x, squares[mark].y, squares[mark].size);
      for (std::size_t i = 0; i < 4; ++i) {
        overlay.add_edge(loop[i], loop[(i + 1) % 4], kLit, 1, mark);
      }
    }
    overlay.build();
    ASSERT_TRUE(overlay.consistent());
    std::vector<std::vector<bool>> faces_of(squares.size(),
                                            std::vector<bool>(overlay.faces().size()));
    std::size_t visited = 0;
    overlay.for_each_marked_face([&](std::uint32_t face, const Overlay::MarkWindings& marks) {
      ++visited;
      int sum = 0;
      for (const Overlay::MarkWinding& own : marks) {
        EXPECT_EQ(own.winding, 1);
        sum += own.winding;
        faces_of[own.mark][face] = true;
      }
      EXPECT_EQ(overlay.faces()[face].winding[kLit], sum);
    });
    EXPECT_EQ(visited, overlay.faces().size() - 1);
    for (std::size_t mark = 0; mark < squares.size(); ++mark) {
      EXPECT_EQ(overlay.exact_area(faces_of[mark]), squares[mark].size * squares[mark].size);
    }
  }
}

TEST(Overlay, HolesAndIslands) {
  Overlay overlay;
  overlay.add_loop(square(0, 0, 10), kReceiver);
  overlay.add_loop(square(2, 2, 6), kTruth);
  overlay.add_loop(square(4, 4, 2), kLit);
  overlay.add_loop(square(20, 0, 1), kLit);
  overlay.add_loop(square(0, -5, 2), kLit);
  overlay.build();
  ASSERT_TRUE(overlay.consistent());
  EXPECT_EQ(overlay.faces().size(), 6u);
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w == Winding{1, 0, 0, 0}; }), 64);
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w == Winding{1, 1, 0, 0}; }), 32);
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w == Winding{1, 1, 1, 0}; }), 4);
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w == Winding{0, 0, 1, 0}; }), 5);
}

TEST(Overlay, CollinearOverlapsAndTVertices) {
  Overlay overlay;
  overlay.add_loop(square(0, 0, 4), kLit);
  overlay.add_loop(square(4, 1, 2), kShadow);
  overlay.add_loop(square(4, 3, 2), kShadow);  // sticks out by one
  overlay.build();
  ASSERT_TRUE(overlay.consistent());
  EXPECT_EQ(overlay.t_vertices(), 3u);  // (4,1), (4,3) and the square's own (4,4)
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w[kShadow] == 1; }), 8);
}

/// A vertex at which all edges cancel, on edges of two layers that lie on each other: it splits
/// neither of them, or they would no longer be the same edge.
TEST(Overlay, AVertexOfEdgesThatCancelSplitsNothing) {
  Overlay overlay;
  const std::vector<ChartPoint> corners = square(0, -2, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    overlay.add_loop({p(2, 0), corners[i], corners[(i + 1) % 4]}, kShadow);
  }
  overlay.add_loop({p(-5, 0), p(6, 0), p(0, 9)}, kShadow);
  overlay.add_loop({p(-5, 0), p(7, 0), p(0, 20)}, kTruth);
  overlay.build();
  ASSERT_TRUE(overlay.consistent());
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w[kTruth] == 1; }), 120);
  EXPECT_GT(overlay.t_vertices(), 0u);
}

TEST(Overlay, ManyLinesThroughOnePoint) {
  Overlay overlay;
  overlay.add_loop({p(-9, -9), p(9, -9), p(9, 9), p(-9, 9)}, kReceiver);
  const int ends[8][2] = {{9, 0}, {9, 9}, {0, 9}, {-9, 9}, {-9, 0}, {-9, -9}, {0, -9}, {9, -9}};
  for (int i = 0; i < 8; ++i) {
    // Triangles that all have the corner (0, 0), given twice each.
    for (int twice = 0; twice < 2; ++twice) {
      overlay.add_loop(
          {p(0, 0), p(ends[i][0], ends[i][1]), p(ends[(i + 1) % 8][0], ends[(i + 1) % 8][1])},
          i % 2 == 0 ? kLit : kShadow);
    }
  }
  overlay.build();
  ASSERT_TRUE(overlay.consistent());
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w[kLit] == 2; }), 162);
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w[kShadow] == 2; }), 162);
}

TEST(Overlay, AreaAgreesWithExactAreaOnRandomTriangles) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    Overlay overlay;
    mpq_class sum;
    for (int i = 0; i < 12; ++i) {
      std::vector<ChartPoint> loop;
      for (int k = 0; k < 3; ++k) {
        const int w = random.integer(1, 3);
        ChartPoint point{random.integer(0, 6), random.integer(0, 6), w};
        reduce(point);
        loop.push_back(point);
      }
      const int turn = orientation(loop[0], loop[1], loop[2]);
      if (turn == 0) continue;
      if (turn < 0) std::swap(loop[0], loop[1]);
      overlay.add_loop(loop, kTruth);
      Overlay alone;
      alone.add_loop(loop, kTruth);
      alone.build();
      sum += alone.exact_area({false, true});
    }
    overlay.build();
    ASSERT_TRUE(overlay.consistent()) << seed;
    mpq_class weighted;
    for (std::size_t f = 1; f < overlay.faces().size(); ++f) {
      std::vector<bool> only(overlay.faces().size(), false);
      only[f] = true;
      const mpq_class area = overlay.exact_area(only);
      EXPECT_GT(area, 0) << seed;
      weighted += area * overlay.faces()[f].winding[kTruth];
    }
    EXPECT_EQ(weighted, sum) << seed;
  }
}

TEST(NormalisedLoop, OrientationIsFree) {
  std::vector<ChartPoint> loop = square(0, 0, 2);
  std::reverse(loop.begin(), loop.end());
  const NormalisedLoop found = normalise(loop);
  EXPECT_TRUE(found.convex);
  EXPECT_FALSE(found.crosses_itself);
  EXPECT_GT(orientation(found.loop[0], found.loop[1], found.loop[2]), 0);
}

TEST(NormalisedLoop, NonConvexIsNoCrossing) {
  const NormalisedLoop found = normalise({p(0, 0), p(4, 0), p(4, 4), p(2, 1), p(0, 4)});
  EXPECT_FALSE(found.convex);
  EXPECT_FALSE(found.crosses_itself);
  EXPECT_EQ(found.edges.size(), 5u);
}

TEST(NormalisedLoop, CrossingCountsByTheNonZeroRule) {
  // A bow tie: two triangles of area 1 each... and both count.
  const NormalisedLoop found = normalise({p(0, 0), p(2, 2), p(2, 0), p(0, 2)});
  EXPECT_TRUE(found.crosses_itself);
  Overlay overlay;
  for (const auto& [a, b] : found.edges) overlay.add_edge(a, b, kLit);
  overlay.build();
  EXPECT_EQ(area_where(overlay, [](const Winding& w) { return w[kLit] == 1; }), 2);
}

TEST(NormalisedLoop, TwiceAroundIsOnce) {
  const NormalisedLoop found =
      normalise({p(0, 0), p(2, 0), p(2, 2), p(0, 2), p(0, 0), p(2, 0), p(2, 2), p(0, 2)});
  EXPECT_TRUE(found.crosses_itself);
  EXPECT_EQ(found.edges.size(), 4u);
}

TEST(NormalisedLoop, NoAreaIsNothing) {
  EXPECT_TRUE(normalise({p(0, 0), p(2, 0), p(4, 0)}).loop.empty());
  EXPECT_TRUE(normalise({p(0, 0), p(2, 0), p(4, 0)}).edges.empty());
  EXPECT_TRUE(normalise({p(0, 0), p(0, 0), p(4, 0)}).edges.empty());
  // A spike out and back adds nothing.
  EXPECT_EQ(normalise({p(0, 0), p(2, 0), p(2, 2), p(2, 5), p(2, 2), p(0, 2)}).edges.size(), 4u);
}

}  // namespace
}  // namespace gnomon::oracle
