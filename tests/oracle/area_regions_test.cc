// SPDX-License-Identifier: GPL-3.0-or-later
// Regions under area lights against hand-computed scenes, and against what many exact points see.
#include "gnomon/oracle/area_regions.h"

#include <gtest/gtest.h>

#include "gnomon/oracle/area_visibility.h"
#include "oracle/geometry/group_overlay.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

mpq_class ratio(int a, int b) { return mpq_class(a) / b; }

struct Fractions {
  mpq_class lit, penumbra, umbra;
  friend bool operator==(const Fractions&, const Fractions&) = default;
  friend void PrintTo(const Fractions& f, std::ostream* out) {
    *out << "lit " << f.lit << ", penumbra " << f.penumbra << ", umbra " << f.umbra;
  }
};

Fractions fractions(const BuiltScene& built, const std::string& id, Side side = Side::kFront) {
  const ExactAnswer answer(built.scene, built.prepared);
  for (const AnswerEntry& entry : answer.entries(0)) {
    if (built.scene.polygons[entry.polygon].id != id || entry.side != side) continue;
    const TrueFractions found = answer.fractions(0, entry);
    EXPECT_EQ(*found.lit.exact + *found.penumbra.exact + *found.umbra.exact, 1);
    EXPECT_TRUE(found.shadow.zero);
    return {*found.lit.exact, *found.penumbra.exact, *found.umbra.exact};
  }
  ADD_FAILURE() << "no entry " << id;
  return {};
}

std::size_t entry_count(const BuiltScene& built, const std::string& id) {
  const ExactAnswer answer(built.scene, built.prepared);
  std::size_t count = 0;
  for (const AnswerEntry& entry : answer.entries(0)) {
    if (built.scene.polygons[entry.polygon].id == id) ++count;
  }
  return count;
}

/// Faces up; the light of the same size at height 4 faces down.
std::vector<Triple> square(double half, double z) {
  return {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
}

TEST(AreaRegions, SquareUnderASquareOfItsSize) {
  // A caster half way: 2 o - a of its corners o and the light's a. The penumbra is [-3, 3]^2, the
  // umbra [-1, 1]^2, on a floor of 16 x 16.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", kFloor)
                               .polygon("lid", square(1, 2))
                               .area("panel", kPanel)
                               .build();
  EXPECT_EQ(fractions(built, "floor"), (Fractions{ratio(220, 256), ratio(32, 256), ratio(4, 256)}));
  EXPECT_EQ(fractions(built, "lid"), (Fractions{1, 0, 0}));
  const AreaVisibility visibility(built.prepared, built.prepared.lights[0]);
  EXPECT_EQ(visibility.at(0, Side::kFront, at(0, 0, 0)).visible, 0);
  const AreaPointVisibility half = visibility.at(0, Side::kFront, at(2, 0, 0));
  EXPECT_EQ(half.visible, mpq_class(1, 2));
  EXPECT_EQ(half.hidden, mpq_class(1, 2));
  EXPECT_EQ(half.state, LightState::kPenumbra);
  EXPECT_EQ(half.caster, 1u);
  EXPECT_EQ(visibility.at(0, Side::kFront, at(2, 2, 0)).hidden, mpq_class(1, 4));
  EXPECT_TRUE(visibility.at(0, Side::kFront, at(3, 0, 0)).on_boundary);
  EXPECT_TRUE(visibility.at(0, Side::kFront, at(1, 1, 0)).on_boundary);
  EXPECT_EQ(visibility.at(0, Side::kFront, at(4, 0, 0)).visible, 1);
}

TEST(AreaRegions, SmallCasterHasNoUmbra) {
  // Of half size: penumbra [-2, 2]^2; a point sees past it everywhere.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", kFloor)
                               .polygon("lid", square(0.5, 2))
                               .area("panel", kPanel)
                               .build();
  EXPECT_EQ(fractions(built, "floor"), (Fractions{ratio(240, 256), ratio(16, 256), 0}));
}

TEST(AreaRegions, CasterThatOnlyShowsItsBackOrDoesNotCast) {
  std::vector<Triple> down = square(1, 2);
  std::reverse(down.begin(), down.end());
  const BuiltScene back =
      SceneBuilder().polygon("floor", kFloor).polygon("lid", down).area("panel", kPanel).build();
  EXPECT_EQ(fractions(back, "floor"), (Fractions{1, 0, 0}));
  EXPECT_EQ(fractions(back, "lid"), (Fractions{0, 0, 1}));
  const BuiltScene both = SceneBuilder()
                              .polygon("floor", kFloor)
                              .polygon("lid", down, true)
                              .area("panel", kPanel)
                              .build();
  EXPECT_EQ(fractions(both, "floor"), (Fractions{ratio(220, 256), ratio(32, 256), ratio(4, 256)}));
  EXPECT_EQ(entry_count(both, "lid"), 1u);
  EXPECT_EQ(fractions(both, "lid", Side::kBack), (Fractions{1, 0, 0}));
  const BuiltScene none = SceneBuilder()
                              .polygon("floor", kFloor)
                              .polygon("lid", square(1, 2), false, false)
                              .area("panel", kPanel)
                              .build();
  EXPECT_EQ(fractions(none, "floor"), (Fractions{1, 0, 0}));
}

TEST(AreaRegions, ReceiverPartlyBehindTheLight) {
  const BuiltScene built = SceneBuilder()
                               .polygon("wall", {{5, -4, 0}, {5, -4, 8}, {5, 4, 8}, {5, 4, 0}})
                               .polygon("ceiling", {{-8, -8, 4}, {-8, 8, 4}, {8, 8, 4}, {8, -8, 4}})
                               .area("panel", kPanel)
                               .build();
  EXPECT_EQ(fractions(built, "wall"), (Fractions{mpq_class(1, 2), 0, mpq_class(1, 2)}));
  // It holds the light: it is in the light's plane, and casts nothing.
  EXPECT_EQ(fractions(built, "ceiling"), (Fractions{0, 0, 1}));
}

TEST(AreaRegions, WallUnderTheMiddleOfTheLight) {
  // p = a + s (o - a), s in [1, 2]: (ax (1 - s), ay + s (oy - ay)): [0, 1] x [-3, 3] for the half
  // of the light with ax < 0, and its mirror image.
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", kFloor)
          .polygon("wall", {{0, -1, 0}, {0, 1, 0}, {0, 1, 2}, {0, -1, 2}}, true)
          .area("panel", kPanel)
          .build();
  EXPECT_EQ(fractions(built, "floor"), (Fractions{ratio(244, 256), ratio(12, 256), 0}));
  EXPECT_EQ(entry_count(built, "wall"), 2u);
  EXPECT_EQ(fractions(built, "wall"), (Fractions{1, 0, 0}));
  EXPECT_EQ(fractions(built, "wall", Side::kBack), (Fractions{1, 0, 0}));
}

TEST(AreaRegions, CasterThatSharesTheLightsEdge) {
  // A wall hangs from the light's edge x = 1 down to z = 2, as wide as the light, and blocks it
  // for what is beyond: at the floor from x = 1 on, in all of it (1 + (1 - ax)) up to x = 3. Umbra
  // needs all of the light: p = 2 o - a with x <= 1 + (1 - 1) = 1: none.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", kFloor)
                               .polygon("wall", {{1, -1, 2}, {1, -1, 4}, {1, 1, 4}, {1, 1, 2}})
                               .area("panel", kPanel)
                               .build();
  const Fractions found = fractions(built, "floor");
  EXPECT_GT(found.penumbra, 0);
  EXPECT_EQ(found.umbra + found.penumbra + found.lit, 1);
  const AreaVisibility visibility(built.prepared, built.prepared.lights[0]);
  EXPECT_EQ(visibility.at(0, Side::kFront, at(2, 0, 0)).hidden, mpq_class(1, 2));
  EXPECT_EQ(visibility.at(0, Side::kFront, at(0, 0, 0)).hidden, 0);
  // Beyond x = 3 lines from the wall's lower edge rise past the light: all of it is hidden.
  EXPECT_EQ(visibility.at(0, Side::kFront, at(4, 0, 0)).visible, 0);
  EXPECT_GT(found.umbra, 0);
}

TEST(AreaRegions, DeepUmbraOfTwoHalves) {
  // The square caster in two halves: none hides all, both together do.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", kFloor)
                               .polygon("left", {{-1, -1, 2}, {0, -1, 2}, {0, 1, 2}, {-1, 1, 2}})
                               .polygon("right", {{0, -1, 2}, {1, -1, 2}, {1, 1, 2}, {0, 1, 2}})
                               .area("panel", kPanel)
                               .build();
  EXPECT_EQ(fractions(built, "floor"), (Fractions{ratio(220, 256), ratio(36, 256), 0}));
  const AreaVisibility visibility(built.prepared, built.prepared.lights[0]);
  const AreaPointVisibility seen = visibility.at(0, Side::kFront, at(0.5, 0.25, 0));
  EXPECT_TRUE(seen.deep());
  EXPECT_EQ(seen.state, LightState::kPenumbra);
  EXPECT_FALSE(visibility.at(0, Side::kFront, at(1.5, 0.25, 0)).deep());
  // They share an edge: no light passes there, whatever the size of the piece.
  const auto square_on_floor = [](double x0, double x1) {
    return std::vector<RationalPoint>{at(x0, -0.5, 0), at(x1, -0.5, 0), at(x1, 0.5, 0),
                                      at(x0, 0.5, 0)};
  };
  EXPECT_TRUE(visibility.hides_all_from(0, Side::kFront, square_on_floor(-1, 1)));
  EXPECT_FALSE(visibility.hides_all_from(0, Side::kFront, square_on_floor(-1, 1.25)));
}

TEST(AreaRegions, DeepUmbraBehindABoxOnTheFloor) {
  // Its top alone hides all from x in [-6, -4], its front from [-2, -1]; the box also in between.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", kFloor)
                               .box("box", {-1, -1, 0}, {1, 1, 2})
                               .area("panel", {{4, -1, 4}, {4, 1, 4}, {6, 1, 4}, {6, -1, 4}})
                               .build();
  const AreaVisibility visibility(built.prepared, built.prepared.lights[0]);
  const auto strip = [](double x0, double x1) {
    return std::vector<RationalPoint>{at(x0, -0.25, 0), at(x1, -0.25, 0), at(x1, 0.25, 0),
                                      at(x0, 0.25, 0)};
  };
  const AreaPointVisibility seen = visibility.at(0, Side::kFront, at(-3, 0, 0));
  EXPECT_EQ(seen.state, LightState::kPenumbra);
  EXPECT_TRUE(seen.deep());
  EXPECT_TRUE(visibility.hides_all_from(0, Side::kFront, strip(-5, -2)));
  EXPECT_TRUE(visibility.hides_all_from(0, Side::kFront, strip(-6, -4)));
  EXPECT_FALSE(visibility.hides_all_from(0, Side::kFront, strip(-6.5, -4)));
}

TEST(AreaRegions, DeepUmbraBehindABoxWhosePanelsMeetInTJunctions) {
  // The same with its top and its front in two panels each, whose corners lie inside edges of
  // others.
  SceneBuilder builder;
  builder.polygon("floor", kFloor)
      .polygon("left", {{-1, -1, 0}, {-1, -1, 2}, {-1, 1, 2}, {-1, 1, 0}})
      .polygon("low", {{1, -1, 0}, {1, 1, 0}, {1, 1, 0.75}, {1, -1, 0.75}})
      .polygon("high", {{1, -1, 0.75}, {1, 1, 0.75}, {1, 1, 2}, {1, -1, 2}})
      .polygon("near", {{-1, -1, 0}, {1, -1, 0}, {1, -1, 2}, {-1, -1, 2}})
      .polygon("far", {{1, 1, 0}, {-1, 1, 0}, {-1, 1, 2}, {1, 1, 2}})
      .polygon("top 1", {{-1, -1, 2}, {1, -1, 2}, {1, 0.125, 2}, {-1, 0.125, 2}})
      .polygon("top 2", {{-1, 0.125, 2}, {1, 0.125, 2}, {1, 1, 2}, {-1, 1, 2}})
      .area("panel", {{4, -1, 4}, {4, 1, 4}, {6, 1, 4}, {6, -1, 4}});
  const BuiltScene built = builder.build();
  const AreaVisibility visibility(built.prepared, built.prepared.lights[0]);
  const auto strip = [](double x0, double x1) {
    return std::vector<RationalPoint>{at(x0, -0.25, 0), at(x1, -0.25, 0), at(x1, 0.25, 0),
                                      at(x0, 0.25, 0)};
  };
  EXPECT_TRUE(visibility.at(0, Side::kFront, at(-3, 0, 0)).deep());
  EXPECT_TRUE(visibility.hides_all_from(0, Side::kFront, strip(-5, -2)));
  EXPECT_FALSE(visibility.hides_all_from(0, Side::kFront, strip(-6.5, -4)));
}

TEST(AreaRegions, WhatIsCertifiedDarkIsDark) {
  // Meshes with shared edges, random triangles of the floor: what is said to be dark must be so at
  // all points tried.
  std::uint64_t certified = 0, tried = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    SceneBuilder builder;
    builder.polygon("floor", kFloor);
    // A bent sheet of four facets around a vertex, and a box.
    const auto some = [&](int low, int high) { return double(random.integer(low, high)); };
    const Triple top{some(-1, 1), some(-1, 1), some(2, 4)};
    const double side = some(2, 4), level = some(1, 2);
    const Triple a{-side, -side, level}, b{side, -side, some(1, 2)}, c{side, side, level},
        d{-side, side, some(1, 3)};
    builder.polygon("1", {a, b, top}).polygon("2", {b, c, top}).polygon("3", {c, d, top});
    if (seed % 3 != 0) {
      // Whole, or in two halves that meet the first facet, or the third, in a T-junction.
      const auto half = [](const Triple& p, const Triple& q) {
        return Triple{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
      };
      if (seed % 4 == 1) {
        builder.polygon("4", {d, a, half(a, top)}).polygon("5", {d, half(a, top), top});
      } else if (seed % 4 == 2) {
        builder.polygon("4", {d, a, half(d, top)}).polygon("5", {half(d, top), a, top});
      } else {
        builder.polygon("4", {d, a, top});
      }
    }
    if (seed % 2 == 0) builder.box("box", {some(-7, -5), -6, 0}, {some(-4, -2), -3, some(1, 3)});
    const double x = some(-5, 5), y = some(-5, 5);
    builder.area("panel", {{x, y, 6}, {x, y + 2, 6}, {x + 2, y + 2, 6}, {x + 2, y, 6}});
    const BuiltScene built = builder.build();
    const AreaVisibility visibility(built.prepared, built.prepared.lights[0]);
    for (int i = 0; i < 12; ++i) {
      const double px = some(-6, 6) / 2, py = some(-6, 6) / 2, size = i % 2 == 0 ? 0.5 : 1.5;
      const std::vector<RationalPoint> triangle{at(px, py, 0), at(px + size, py, 0),
                                                at(px, py + size, 0)};
      ++tried;
      if (!visibility.hides_all_from(0, Side::kFront, triangle)) continue;
      ++certified;
      for (int k = 0; k < 6; ++k) {
        const double u = some(0, 64) / 64, v = (1 - u) * some(0, 64) / 64;
        EXPECT_TRUE(visibility.at(0, Side::kFront, at(px + u * size, py + v * size, 0)).deep())
            << seed << " " << px << " " << py;
      }
    }
  }
  EXPECT_GT(certified, tried / 20);
  EXPECT_LT(certified, tried);
}

TEST(AreaRegions, NumbersOfHundredsOfBits) {
  for (double scale : {0x1p-900, 1.0, 0x1p900}) {
    const auto scaled = [&](std::vector<Triple> loop) {
      for (Triple& vertex : loop) {
        for (double& coordinate : vertex) coordinate *= scale;
      }
      return loop;
    };
    const BuiltScene built = SceneBuilder()
                                 .polygon("floor", scaled(kFloor))
                                 .polygon("lid", scaled(square(1, 2)))
                                 .area("panel", scaled(kPanel))
                                 .build();
    EXPECT_EQ(fractions(built, "floor"),
              (Fractions{ratio(220, 256), ratio(32, 256), ratio(4, 256)}));
  }
}

/// Where a point lies: 1 inside, 0 on the border, -1 outside of all loops.
int place_in(const std::vector<ShadowPiece>& pieces, const ChartPoint& point) {
  int best = -1;
  for (const ShadowPiece& piece : pieces) {
    int least = 1;
    for (std::size_t e = 0; e < piece.loop.size(); ++e) {
      least = std::min(least,
                       orientation(piece.loop[e], piece.loop[(e + 1) % piece.loop.size()], point));
    }
    best = std::max(best, least);
  }
  return best;
}

struct Agreement {
  std::uint64_t compared = 0, boundary = 0, penumbra = 0, umbra = 0, behind = 0;
};

void agree(const BuiltScene& built, std::uint64_t seed, Agreement& counts) {
  const ExactAnswer answer(built.scene, built.prepared);
  const AreaVisibility visibility(built.prepared, built.prepared.lights[0]);
  Random random(seed);
  for (const AnswerEntry& entry : answer.entries(0)) {
    const Side side = entry.side;
    for (const ReceiverGroup& group : entry.groups) {
      if (!group.faces) continue;
      for (std::uint32_t part : group.parts) {
        const Chart chart(support_of(built.prepared, part));
        const std::vector<Integers3> loop = grid_loop(built.prepared, part);
        const AreaShade& shade = answer.area_shade(0, part, entry.side);
        std::vector<ShadowPiece> behind;
        if (!shade.behind.empty()) behind.push_back({part, shade.behind});
        for (int i = 0; i < 16; ++i) {
          Integers3 sum;
          mpz_class weights;
          for (const Integers3& vertex : loop) {
            const int weight = random.integer(1, i < 6 ? 3 : 1000);
            weights += weight;
            for (int k = 0; k < 3; ++k) sum[k] += weight * vertex[k];
          }
          RationalPoint point;
          for (int k = 0; k < 3; ++k) {
            mpq_class coordinate(sum[k], weights);
            coordinate.canonicalize();
            point[k] =
                built.prepared.geometry.origin[k] + built.prepared.geometry.step * coordinate;
          }
          const AreaPointVisibility seen = visibility.at(part, side, point, i % 4 == 0);
          const ChartPoint place = chart.project(to_grid(built.prepared.geometry, point));
          if (seen.on_boundary) {
            ++counts.boundary;
            continue;
          }
          ++counts.compared;
          ASSERT_EQ(seen.behind_light, place_in(behind, place) > 0) << seed << " part " << part;
          if (seen.behind_light) {
            ++counts.behind;
            continue;
          }
          const int in_penumbra = place_in(shade.penumbra, place);
          const int in_umbra = place_in(shade.umbra, place);
          switch (seen.state) {
            case LightState::kUmbra:
              ++counts.umbra;
              EXPECT_GE(in_umbra, 0) << seed << " part " << part;
              break;
            case LightState::kPenumbra:
              ++counts.penumbra;
              EXPECT_GT(in_penumbra, 0) << seed << " part " << part;
              EXPECT_LT(in_umbra, 0) << seed << " part " << part;
              break;
            default:
              EXPECT_LT(in_penumbra, 0) << seed << " part " << part;
          }
          if (i % 4 != 0) continue;
          mpq_class most;
          for (const auto& [caster, hidden] : seen.by_caster) {
            most = std::max(most, hidden);
            const bool known =
                std::any_of(shade.penumbra.begin(), shade.penumbra.end(),
                            [&](const ShadowPiece& p) { return p.caster == caster; });
            EXPECT_TRUE(known) << seed << " part " << part << " caster " << caster;
          }
          EXPECT_GE(seen.hidden, most);
          EXPECT_LE(seen.hidden + seen.visible, 1);
          EXPECT_EQ(seen.state == LightState::kLit, seen.hidden == 0);
        }
      }
    }
  }
}

TEST(AreaRegions, AgreeWithVisibilityOnLatticeSoups) {
  Agreement counts;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    agree(lattice_area_soup(seed, 10, 4), seed, counts);
  }
  // Larger faces and lights on fewer places: more of them coplanar, shared and touching.
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    agree(lattice_area_soup(1000 + seed, 8, 2), seed, counts);
  }
  EXPECT_GT(counts.compared, 5000u);
  EXPECT_GT(counts.penumbra, 1000u);
  EXPECT_GT(counts.umbra, 200u);
  EXPECT_GT(counts.behind, 200u);
  EXPECT_LT(counts.boundary, counts.compared / 4);
}

}  // namespace
}  // namespace gnomon::oracle
