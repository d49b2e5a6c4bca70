// SPDX-License-Identifier: GPL-3.0-or-later
// Regions against hand-computed scenes, and against the visibility of many exact points.
#include "gnomon/oracle/point_regions.h"

#include <gtest/gtest.h>

#include "gnomon/oracle/visibility.h"
#include "oracle/geometry/group_overlay.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

/// Canonical, unlike mpq_class(a, b).
mpq_class ratio(int a, int b) { return mpq_class(a) / b; }

mpq_class lit_fraction(const BuiltScene& built, std::uint32_t light, const std::string& id,
                       Side side = Side::kFront) {
  const ExactAnswer answer(built.scene, built.prepared);
  for (const AnswerEntry& entry : answer.entries(light)) {
    if (built.scene.polygons[entry.polygon].id != id || entry.side != side) continue;
    const TrueFractions found = answer.fractions(light, entry);
    EXPECT_EQ(*found.lit.exact + *found.shadow.exact, 1);
    return *found.lit.exact;
  }
  ADD_FAILURE() << "no entry " << id;
  return -1;
}

TEST(PointRegions, SquareOverFloor) {
  // A unit square at half height: its shadow has twice its side.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}})
                               .polygon("quad", {{3, 3, 1}, {4, 3, 1}, {4, 4, 1}, {3, 4, 1}})
                               .point("bulb", {3, 3, 2})
                               .build();
  EXPECT_EQ(lit_fraction(built, 0, "floor"), ratio(60, 64));
  EXPECT_EQ(lit_fraction(built, 0, "quad"), 1);
}

TEST(PointRegions, BoxOnFloorLeaksNothing) {
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}})
                               .box("box", {2, 2, 0}, {4, 4, 2})
                               .sun("sun", {1, 0, 1})
                               .build();
  // The sun comes from +x at 45 degrees: the box's shadow is [0,4] x [2,4], under the box included.
  EXPECT_EQ(lit_fraction(built, 0, "floor"), ratio(64 - 8, 64));
  EXPECT_EQ(lit_fraction(built, 0, "box.1"), 1);
  EXPECT_EQ(lit_fraction(built, 0, "box.5"), 1);
  EXPECT_EQ(lit_fraction(built, 0, "box.4"), 0);  // faces away
  EXPECT_EQ(lit_fraction(built, 0, "box.2"), 0);  // the sun is in its plane
}

TEST(PointRegions, CoplanarPolygonsDoNotShadowEachOther) {
  const BuiltScene built = SceneBuilder()
                               .polygon("a", {{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}})
                               .polygon("b", {{2, 2, 1}, {6, 2, 1}, {6, 6, 1}, {2, 6, 1}})
                               .polygon("floor", {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}})
                               .sun("sun", {0, 0, 1})
                               .build();
  EXPECT_EQ(lit_fraction(built, 0, "a"), 1);
  EXPECT_EQ(lit_fraction(built, 0, "b"), 1);
  EXPECT_EQ(lit_fraction(built, 0, "floor"), ratio(64 - 28, 64));
}

TEST(PointRegions, LightInThePlaneOfAPolygon) {
  const BuiltScene built = SceneBuilder()
                               .polygon("wall", {{4, 0, 0}, {4, 8, 0}, {4, 8, 4}, {4, 0, 4}}, true)
                               .polygon("floor", {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}})
                               .point("lamp", {4, 4, 8})
                               .build();
  EXPECT_EQ(lit_fraction(built, 0, "wall"), 0);
  EXPECT_EQ(lit_fraction(built, 0, "floor"), 1);  // edge-on, it casts nothing
}

TEST(PointRegions, SlantedPolygonThroughAnothersPlane) {
  // B floats above the plane of A's middle: A rises through B's plane, and B shadows only the part
  // of A below it.
  const BuiltScene built = SceneBuilder()
                               .polygon("A", {{0, 0, 0}, {4, 0, 4}, {4, 4, 4}, {0, 4, 0}}, true)
                               .polygon("B", {{0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}, true)
                               .sun("sun", {0, 0, 1})
                               .build();
  EXPECT_EQ(lit_fraction(built, 0, "A"), mpq_class(3, 4));
  EXPECT_EQ(lit_fraction(built, 0, "B"), 1);
}

TEST(PointRegions, CrossingPolygons) {
  // B stands on its edge through the floor; the sun is low from +x.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}})
                               .polygon("B", {{4, 2, -2}, {4, 6, -2}, {4, 6, 2}, {4, 2, 2}}, true)
                               .sun("sun", {1, 0, 1})
                               .build();
  EXPECT_EQ(lit_fraction(built, 0, "floor"), ratio(64 - 8, 64));
  EXPECT_EQ(lit_fraction(built, 0, "B"), mpq_class(1, 2));  // below the floor it is shadowed
}

TEST(PointRegions, SidesAndCasts) {
  const std::vector<Triple> down{{3, 4, 1}, {4, 4, 1}, {4, 3, 1}, {3, 3, 1}};
  for (const bool two_sided : {false, true}) {
    for (const bool casts : {false, true}) {
      const BuiltScene built = SceneBuilder()
                                   .polygon("floor", {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}})
                                   .polygon("quad", down, two_sided, casts)
                                   .sun("sun", {0, 0, 1})
                                   .build();
      EXPECT_EQ(lit_fraction(built, 0, "floor"),
                two_sided && casts ? mpq_class(63, 64) : mpq_class(1));
      if (two_sided) {
        EXPECT_EQ(lit_fraction(built, 0, "quad", Side::kBack), 1);
      } else {
        EXPECT_EQ(lit_fraction(built, 0, "quad"), 0);
      }
    }
  }
}

TEST(PointRegions, LampInsideAClosedBox) {
  SceneBuilder builder;
  builder.box("room", {0, 0, 0}, {4, 4, 4}).point("lamp", {1, 1, 1});
  BuiltScene built = builder.build();
  for (int wall = 0; wall < 6; ++wall) {
    EXPECT_EQ(lit_fraction(built, 0, "room." + std::to_string(wall)), 0);  // outward: faces away
  }
}

TEST(PointRegions, LightInsideOfHundredsOfBits) {
  // Mixed magnitudes: the same scene with exponents far apart stays exact.
  for (double scale : {0x1p-900, 1.0, 0x1p900}) {
    const auto s = [&](double v) { return v * scale; };
    const BuiltScene built =
        SceneBuilder()
            .polygon("floor", {{0, 0, 0}, {s(8), 0, 0}, {s(8), s(8), 0}, {0, s(8), 0}})
            .polygon(
                "quad",
                {{s(3), s(3), s(1)}, {s(4), s(3), s(1)}, {s(4), s(4), s(1)}, {s(3), s(4), s(1)}})
            .point("bulb", {s(3), s(3), s(2)})
            .build();
    EXPECT_EQ(lit_fraction(built, 0, "floor"), ratio(60, 64));
  }
}

/// Points of a receiver: lattice points and random ones, on its plane.
void agree(const BuiltScene& built, std::uint64_t seed, std::uint64_t& compared,
           std::uint64_t& shadowed) {
  const ExactAnswer answer(built.scene, built.prepared);
  Random random(seed);
  for (std::uint32_t light = 0; light < built.prepared.lights.size(); ++light) {
    const VisibilityTest visibility(built.prepared, built.prepared.lights[light]);
    for (const AnswerEntry& entry : answer.entries(light)) {
      for (const ReceiverGroup& group : entry.groups) {
        if (!group.faces) continue;
        for (std::uint32_t part : group.parts) {
          const Chart chart(support_of(built.prepared, part));
          const std::vector<Integers3> loop = grid_loop(built.prepared, part);
          for (int i = 0; i < 12; ++i) {
            Integers3 sum;
            mpz_class weights;
            const int range = i < 6 ? 3 : 1000;
            for (const Integers3& vertex : loop) {
              const int weight = random.integer(i < 6 ? 0 : 1, range);
              weights += weight;
              for (int k = 0; k < 3; ++k) sum[k] += weight * vertex[k];
            }
            if (weights == 0) continue;
            RationalPoint point;
            for (int k = 0; k < 3; ++k) {
              mpq_class coordinate(sum[k], weights);
              coordinate.canonicalize();
              point[k] =
                  built.prepared.geometry.origin[k] + built.prepared.geometry.step * coordinate;
            }
            const PointVisibility seen = visibility.at(part, point);
            const ChartPoint place = chart.project(to_grid(built.prepared.geometry, point));
            bool inside = false, on_border = false;
            for (const ShadowPiece& piece : answer.shadows(light, part)) {
              int least = 1;
              for (std::size_t e = 0; e < piece.loop.size(); ++e) {
                least = std::min(
                    least,
                    orientation(piece.loop[e], piece.loop[(e + 1) % piece.loop.size()], place));
              }
              inside = inside || least > 0;
              on_border = on_border || least == 0;
            }
            if (seen.visibility == Visibility::kBoundary) {
              // Some shadow's border, or another shadow's beyond the receiver's own border.
              EXPECT_FALSE(inside) << seed;
              continue;
            }
            ++compared;
            if (seen.visibility == Visibility::kShadow) {
              ++shadowed;
              EXPECT_TRUE(inside || on_border) << seed << " part " << part;
            } else {
              EXPECT_FALSE(inside || on_border) << seed << " part " << part;
            }
          }
        }
      }
    }
  }
}

TEST(PointRegions, AgreeWithVisibilityOnLatticeSoups) {
  std::uint64_t compared = 0, shadowed = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    agree(lattice_soup(seed, 12, 4), seed, compared, shadowed);
  }
  EXPECT_GT(compared, 5000u);
  EXPECT_GT(shadowed, 1000u);
}

}  // namespace
}  // namespace gnomon::oracle
