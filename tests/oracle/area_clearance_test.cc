// SPDX-License-Identifier: GPL-3.0-or-later
// How far one vertex must move for a claim under an area light to be right: on scenes where the
// least move is known, and on soups against scenes with moved vertices.
#include "oracle/judge/area_clearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gnomon/oracle/verdict.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

const std::vector<Triple> kLamp{{-1, -1, 8}, {-1, 1, 8}, {1, 1, 8}, {1, -1, 8}};  // looks down

std::optional<double> clearance_at(const BuiltScene& built, const std::string& polygon,
                                   const RationalPoint& point, const AreaClaim& claim) {
  const PreparedLight& light = built.prepared.lights[0];
  const AreaVisibility visibility(built.prepared, light);
  std::vector<std::uint32_t> parts;
  for (std::uint32_t part = 0; part < built.prepared.parts.size(); ++part) {
    if (built.scene.polygons[built.prepared.parts[part].polygon].id == polygon) {
      parts.push_back(part);
    }
  }
  return area_clearance(built.prepared, light, visibility, parts, Side::kFront, point, claim);
}

BuiltScene under_a_sheet(double x) {
  // A sheet half way up, from x to the right: what is left of 2 x - 1 sees all of the lamp.
  return SceneBuilder()
      .polygon("floor", {{-16, -16, 0}, {16, -16, 0}, {16, 16, 0}, {-16, 16, 0}})
      .polygon("sheet", {{x, -16, 4}, {16, -16, 4}, {16, 16, 4}, {x, 16, 4}})
      .area("lamp", kLamp)
      .build();
}

TEST(AreaClearance, AnEdgeIsCarriedAcrossALineToTheLight) {
  const BuiltScene built = under_a_sheet(2);
  // From (2, 0, 0) to the lamp's corners at x = 1: x = 3/2 at half the way, 1/2 from the sheet.
  const RationalPoint lit{2, 0, 0};
  const auto to_penumbra = clearance_at(built, "floor", lit, {.state = LightState::kPenumbra});
  ASSERT_TRUE(to_penumbra);
  EXPECT_GE(*to_penumbra, 0.5);
  EXPECT_LE(*to_penumbra, 2.00001 * 0.5);
  // From (6, 0, 0) to those at x = -1: 5/2, 1/2 inside the sheet.
  const auto to_part = clearance_at(built, "floor", RationalPoint{6, 0, 0},
                                    {.state = LightState::kPenumbra, .per_caster = true});
  ASSERT_TRUE(to_part);
  EXPECT_GE(*to_part, 0.5);
  EXPECT_LE(*to_part, 2.00001 * 0.5);
  // Penumbra is right in the umbra, unless umbra is told per caster.
  EXPECT_FALSE(
      clearance_at(built, "floor", RationalPoint{6, 0, 0}, {.state = LightState::kPenumbra}));
  // No corner of the sheet frees the whole lamp, but the floor may be bent up through the sheet: by
  // a corner of weight at least 1/3 in some triangle.
  const auto to_lit =
      clearance_at(built, "floor", RationalPoint{6, 0, 0}, {.state = LightState::kLit});
  ASSERT_TRUE(to_lit);
  EXPECT_GE(*to_lit, 4);
  EXPECT_LE(*to_lit, 12.0001);
}

TEST(AreaClearance, ACornerIsPulledBack) {
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", {{-16, -16, 0}, {16, -16, 0}, {16, 16, 0}, {-16, 16, 0}})
          .polygon("tip", {{0.25, 0, 4}, {9, -1, 4}, {9, 1, 4}})
          .area("lamp", kLamp)
          .build();
  // From the origin the lamp is seen within x <= 1/2 at height 4; the tip reaches to 1/4.
  const auto clearance =
      clearance_at(built, "floor", RationalPoint{0, 0, 0}, {.state = LightState::kLit});
  ASSERT_TRUE(clearance);
  EXPECT_GE(*clearance, 0.25);
  EXPECT_LE(*clearance, 0.2500001);
}

BuiltScene window_behind_wall(double behind) {
  return SceneBuilder()
      .polygon("wall", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}})
      .polygon("window", {{1, 1, -behind}, {2, 1, -behind}, {2, 2, -behind}, {1, 2, -behind}})
      .area("lamp", kLamp)
      .build();
}

TEST(AreaClearance, AWindowIsMovedOutOfItsWall) {
  const BuiltScene built = window_behind_wall(0x1p-30);
  const RationalPoint inside{mpq_class(3, 2), mpq_class(5, 4), mpq_class(-1, 1 << 30)};
  const auto clearance = clearance_at(built, "window", inside, {.state = LightState::kLit});
  ASSERT_TRUE(clearance);
  EXPECT_GE(*clearance, 0x1p-30);
  EXPECT_LE(*clearance, 3.00001 * 0x1p-30);
}

TEST(AreaClearance, VerdictsSetIllConditionedErrorsApart) {
  const BuiltScene built = window_behind_wall(1e-10);
  const ExactAnswer answer(built.scene, built.prepared);
  Claims wrong = exact_candidate(answer);
  bool found = false;
  for (ClaimedPolygon& polygon : wrong.lights[0].polygons) {
    if (polygon.id != "window") continue;
    for (ClaimedFragment& fragment : polygon.fragments) {
      EXPECT_NE(fragment.state, LightState::kLit);
      fragment.state = LightState::kLit;
      found = true;
    }
  }
  ASSERT_TRUE(found);
  const auto judged = [&](double clearance) {
    CertifyOptions options;
    options.clearance = clearance;
    return *certify(answer, wrong, options);
  };
  const Report plain = judged(0);
  EXPECT_EQ(plain.verdict, Verdict::kFailed);
  ASSERT_TRUE(plain.worst && plain.worst->clearance);
  EXPECT_LE(*plain.worst->clearance, 3.1e-10);
  EXPECT_EQ(judged(1e-9).verdict, Verdict::kWithinTolerance);
  EXPECT_EQ(judged(1e-9).totals.ill_conditioned_regions, 1u);
  EXPECT_EQ(judged(1e-11).verdict, Verdict::kFailed);
}

TEST(AreaClearance, OnSoupsWrongClaimsAloneHaveOne) {
  std::size_t asked = 0, known = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const BuiltScene built = lattice_area_soup(seed, 10, 4);
    const PreparedLight& light = built.prepared.lights[0];
    const AreaVisibility visibility(built.prepared, light);
    for (std::uint32_t part = 0; part < built.prepared.parts.size(); ++part) {
      const auto loop = built.prepared.loop(built.prepared.parts[part]);
      RationalPoint point;
      const Geometry& geometry = built.prepared.geometry;
      for (int k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
          point[k] += (geometry.origin[k] + geometry.step * geometry.grid.at(loop[i], k)) *
                      mpq_class(static_cast<long>(3 + i), 12);
        }
      }
      const AreaPointVisibility seen = visibility.at(part, Side::kFront, point);
      for (const LightState state : {LightState::kLit, LightState::kPenumbra, LightState::kUmbra}) {
        for (const bool per_caster : {false, true}) {
          const AreaClaim claim{state, per_caster};
          const auto clearance = area_clearance(built.prepared, light, visibility,
                                                std::vector{part}, Side::kFront, point, claim);
          if (seen.behind_light || claim.is_right(seen)) {
            EXPECT_FALSE(clearance);
            continue;
          }
          ++asked;
          if (!clearance) continue;
          ++known;
          EXPECT_GT(*clearance, 0);
          EXPECT_TRUE(std::isfinite(*clearance));
        }
      }
    }
  }
  std::printf("%zu wrong claims, %zu with a known move\n", asked, known);
  EXPECT_GT(asked, 100u);
  EXPECT_GT(known, asked / 5);
}

}  // namespace
}  // namespace gnomon::oracle
