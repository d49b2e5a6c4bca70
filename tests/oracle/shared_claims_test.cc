// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of several lights at once, of painted loops and of some classes alone, judged by the
// exact regions, by points, and claim by claim.
#include "gnomon/result/shared_claims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "gnomon/oracle/witness_check.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

using testing::HasSubstr;

/// A region of one side; its class counts only where claims are told light by light.
ClaimedFragment strip(double x0, double x1, LightState state = LightState::kLit, double z = 0) {
  return rectangle(state, x0, 0, x1, 4, z);
}

SharedFragment shared(double x0, double x1, double z = 0) {
  SharedFragment fragment;
  static_cast<ClaimedShape&>(fragment) = strip(x0, x1, LightState::kLit, z);
  return fragment;
}

SharedFragment lit_by(std::vector<std::string> lights, double x0, double x1, double z = 0) {
  SharedFragment fragment = shared(x0, x1, z);
  fragment.lit_by = std::move(lights);
  return fragment;
}

SharedFragment painted(std::uint64_t level, std::vector<std::string> dark_for, double x0,
                       double x1) {
  SharedFragment fragment = shared(x0, x1);
  fragment.level = level;
  fragment.dark_for = std::move(dark_for);
  return fragment;
}

/// A floor of 4 x 4 under a lid over its half x < 2 and three suns: from above, from the right (its
/// shadow ends at x = 1), and from below, which reaches nothing.
class Shared : public testing::Test {
 protected:
  Shared()
      : built_(SceneBuilder()
                   .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                   .polygon("lid", {{0, 0, 1}, {2, 0, 1}, {2, 4, 1}, {0, 4, 1}})
                   .sun("above", {0, 0, 1})
                   .sun("right", {1, 0, 1})
                   .sun("below", {0, 0, -1})
                   .build()),
        answer_(built_.scene, built_.prepared) {
    combined_.combined = {
        {"floor",
         Side::kFront,
         true,
         {lit_by({}, 0, 1), lit_by({"right"}, 1, 2), lit_by({"above", "right"}, 2, 4)}},
        {"lid", Side::kFront, true, {lit_by({"above", "right"}, 0, 2, 1)}}};
    overlay_.overlay = {{"floor",
                         Side::kFront,
                         true,
                         {painted(2, {"above", "right"}, 0, 1), painted(1, {"above"}, 0, 2)}}};
    overlay_.overlay->front().fragments[0].on = 1;
  }

  struct Outcome {
    Report report, by_points;
    WitnessReport claims;

    bool right() const {
      return report.verdict == Verdict::kIdentical &&
             by_points.verdict == Verdict::kWithinTolerance && claims.violations == 0;
    }
    /// No way of judging lets it pass.
    bool wrong() const { return report.verdict == Verdict::kFailed && claims.violations > 0; }
  };

  Outcome judge(const Claims& claims) const {
    CertifyOptions points;
    points.most_pairs = 0;
    points.points_a_polygon = 64;
    return {*certify(answer_, claims, {}), *certify(answer_, claims, points),
            check_witnesses(built_.scene, built_.prepared, claims)};
  }

  Claims one_light(const std::function<void(ClaimedLight&)>& change) const {
    Claims claims = exact_candidate(answer_);
    change(claims.lights[0]);
    return claims;
  }

  BuiltScene built_;
  ExactAnswer answer_;
  Claims combined_, overlay_;
};

// --- Several lights together ---

TEST_F(Shared, CombinedIsRight) {
  EXPECT_TRUE(judge(combined_).right());
  // Beside the lights' own fragments.
  Claims both = exact_candidate(answer_);
  both.combined = combined_.combined;
  EXPECT_TRUE(judge(both).right());
}

TEST_F(Shared, CombinedWithEmptiedSetsFails) {
  Claims both = exact_candidate(answer_);
  both.combined = combined_.combined;
  for (SharedPolygon& polygon : *both.combined) {
    for (SharedFragment& fragment : polygon.fragments) fragment.lit_by.clear();
  }
  const Outcome found = judge(both);
  EXPECT_TRUE(found.wrong());
  EXPECT_EQ(found.by_points.verdict, Verdict::kFailed);
  ASSERT_TRUE(found.report.worst);
  EXPECT_EQ(found.report.worst->block, Block::kCombined);
  EXPECT_EQ(found.report.worst->found, LightState::kShadow);
  EXPECT_EQ(found.report.worst->truth, LightState::kLit);
  EXPECT_EQ(found.claims.findings[0].block, Block::kCombined);
  EXPECT_THAT(found.claims.findings[0].text, HasSubstr("some of a shadow fragment is lit"));
}

TEST_F(Shared, OneWrongLightOfOneFragmentFails) {
  for (std::size_t f = 0; f < 3; ++f) {
    for (const std::string light : {"above", "right", "below"}) {
      Claims claims = combined_;
      std::vector<std::string>& ids = claims.combined->front().fragments[f].lit_by;
      if (std::erase(ids, light) == 0) ids.push_back(light);
      const Outcome found = judge(claims);
      EXPECT_TRUE(found.wrong()) << f << light;
      ASSERT_TRUE(found.report.worst);
      EXPECT_EQ(found.report.worst->light, light);
      EXPECT_EQ(found.report.worst->polygon, "floor");
    }
  }
}

TEST_F(Shared, TilingIsToldOnce) {
  Claims gap = combined_;
  gap.combined->front().fragments[2] = lit_by({"above", "right"}, 2, 3);
  const Outcome found = judge(gap);
  EXPECT_TRUE(found.wrong());
  EXPECT_EQ(found.report.totals.regions, 1u);
  EXPECT_EQ(found.claims.violations, 1u);
  Claims overlap = combined_;
  overlap.combined->front().fragments.push_back(lit_by({"above", "right"}, 3, 4));
  EXPECT_EQ(judge(overlap).report.totals.regions, 1u);
  EXPECT_TRUE(judge(overlap).wrong());
  Claims missing = combined_;
  missing.combined->pop_back();
  EXPECT_TRUE(judge(missing).wrong());
}

TEST_F(Shared, UnknownNamesAreProblems) {
  const auto first_problem = [&](const std::function<void(SharedPolygon&)>& change) {
    Claims claims = combined_;
    change(claims.combined->front());
    const Outcome found = judge(claims);
    EXPECT_TRUE(found.wrong());
    EXPECT_FALSE(found.report.problems.empty());
    return found.report.problems.empty() ? "" : found.report.problems[0];
  };
  EXPECT_EQ(first_problem([](SharedPolygon& p) { p.fragments[1].lit_by[0] = "lamp"; }),
            "/combined/0/fragments/1/lit_by/0: no light 'lamp' in the scene");
  EXPECT_EQ(first_problem([](SharedPolygon& p) { p.id = "ground"; }),
            "/combined/0: no polygon 'ground' in the scene");
  EXPECT_EQ(first_problem([](SharedPolygon& p) { p.fragments[0].penumbra_of = {"above"}; }),
            "/combined/0/fragments/0/penumbra_of/0: light 'above' is no area light and has no "
            "penumbra");
  EXPECT_EQ(first_problem([](SharedPolygon& p) { p.id = "lid"; }),
            "/combined/1: polygon 'lid' (front) is listed twice");
}

// --- Shadows painted on shadows ---

TEST_F(Shared, OverlayIsRightInAnyOrderOfTheList) {
  EXPECT_TRUE(judge(overlay_).right());
  Claims turned = overlay_;
  auto& list = turned.overlay->front().fragments;
  std::swap(list[0], list[1]);
  list[0].on.reset();
  list[1].on = 0;
  EXPECT_TRUE(judge(turned).right());
}

TEST_F(Shared, OverlayPaintedInTheWrongOrderFails) {
  Claims claims = overlay_;
  auto& list = claims.overlay->front().fragments;
  list[0].on.reset();
  list[0].level = 1;
  list[1].level = 2;
  const Outcome found = judge(claims);
  EXPECT_TRUE(found.wrong());
  EXPECT_EQ(found.report.worst->light, "right");
  EXPECT_EQ(found.report.worst->block, Block::kOverlay);
  // Of one level, and of two minds.
  list[1].level = 1;
  EXPECT_TRUE(judge(claims).wrong());
  claims = overlay_;
  claims.overlay->front().fragments.erase(claims.overlay->front().fragments.begin());
  EXPECT_TRUE(judge(claims).wrong());
  claims.overlay->clear();
  EXPECT_TRUE(judge(claims).wrong());
}

TEST_F(Shared, OwnersAreChecked) {
  const auto first_problem = [&](const std::function<void(SharedFragment&)>& change) {
    Claims claims = overlay_;
    change(claims.overlay->front().fragments[0]);
    const Outcome found = judge(claims);
    EXPECT_TRUE(found.wrong());
    return found.report.problems.empty() ? "" : found.report.problems[0];
  };
  EXPECT_EQ(first_problem([](SharedFragment& f) { f.on = 7; }),
            "/overlay/0/painted/0/on: there is no painted loop 7");
  EXPECT_EQ(first_problem([](SharedFragment& f) { f.level = 1; }),
            "/overlay/0/painted/0/on: the owner's level 1 is not below 1");
  EXPECT_EQ(first_problem([](SharedFragment& f) { f.dark_for = {"right"}; }),
            "/overlay/0/painted/0/dark_for: light 'above' is missing, for which the owner is dark");
}

// --- One light: loops over each other, backgrounds, classes that are listed ---

TEST_F(Shared, TheLastLoopThatHoldsAPointCounts) {
  const auto with = [&](std::vector<ClaimedFragment> fragments, LightState background) {
    return one_light([&](ClaimedLight& light) {
      light.cover = Cover::kOverlay;
      light.background = background;
      for (std::size_t i = 0; i < fragments.size(); ++i) {
        fragments[i].level = i;
        if (fragments[i].state == LightState::kShadow) fragments[i].caster = "lid";
      }
      light.polygons[0].fragments = fragments;
    });
  };
  using enum LightState;
  EXPECT_TRUE(judge(with({strip(0, 1.5, kShadow), strip(0.5, 2, kShadow)}, kLit)).right());
  EXPECT_TRUE(judge(with({strip(0, 4, kLit), strip(0, 2, kShadow)}, kLit)).right());
  EXPECT_TRUE(
      judge(with({strip(0, 2, kShadow), strip(2, 3, kLit), strip(3, 4, kLit)}, kLit)).right());
  EXPECT_TRUE(
      judge(with({strip(0, 2, kShadow), strip(0, 1, kLit), strip(0, 1, kShadow)}, kLit)).right());
  EXPECT_TRUE(judge(with({strip(0, 2, kShadow), strip(0, 4, kLit)}, kLit)).wrong());
  EXPECT_TRUE(judge(with({strip(0, 1.5, kShadow), strip(0.5, 1.75, kShadow)}, kLit)).wrong());
  EXPECT_TRUE(judge(with({strip(0, 2, kShadow)}, kShadow)).wrong());
  // Side by side between loops that they hide and are hidden by.
  EXPECT_TRUE(judge(with({strip(0, 1, kShadow), strip(0.5, 1.5, kLit), strip(1, 2, kShadow)}, kLit))
                  .wrong());
}

TEST_F(Shared, HolesOfLoopsAreHonoured) {
  const auto with_hole = [&](double from, double to) {
    return one_light([&](ClaimedLight& light) {
      ClaimedFragment lit = strip(0, 4);
      lit.holes = {strip(from, to).loop};
      light.background = LightState::kShadow;
      light.polygons[0].fragments = {lit};
    });
  };
  EXPECT_TRUE(judge(with_hole(0, 2)).right());
  EXPECT_TRUE(judge(with_hole(0, 1)).wrong());
  EXPECT_TRUE(judge(with_hole(0, 3)).wrong());
}

TEST_F(Shared, OnlyListedClassesAreCompared) {
  using enum LightState;
  const auto listing = [&](std::vector<LightState> listed, std::vector<ClaimedFragment> fragments) {
    return one_light([&](ClaimedLight& light) {
      light.listed = listed;
      for (ClaimedFragment& fragment : fragments) {
        if (fragment.state == kShadow) fragment.caster = "lid";
      }
      light.polygons[0].fragments = fragments;
    });
  };
  EXPECT_TRUE(
      judge(listing({kShadow}, {strip(0, 1, kShadow), strip(1, 2, kShadow)})).claims.violations ==
      0);
  EXPECT_TRUE(judge(listing({kShadow}, {strip(0, 1, kShadow)})).wrong());
  EXPECT_TRUE(judge(listing({kShadow}, {strip(0, 3, kShadow)})).wrong());
  EXPECT_TRUE(judge(listing({kLit}, {strip(2, 4, kLit)})).report.verdict == Verdict::kIdentical);
  EXPECT_TRUE(judge(listing({kLit}, {strip(2, 3, kLit)})).wrong());
  EXPECT_EQ(judge(listing({}, {})).report.verdict, Verdict::kIdentical);
}

TEST_F(Shared, ABackgroundIsProvedClaimByClaim) {
  const auto with = [&](LightState background, ClaimedFragment fragment) {
    return one_light([&](ClaimedLight& light) {
      light.background = background;
      if (fragment.state == LightState::kShadow) fragment.caster = "lid";
      light.polygons[0].fragments = {fragment};
    });
  };
  EXPECT_TRUE(judge(with(LightState::kLit, strip(0, 2, LightState::kShadow))).right());
  EXPECT_TRUE(judge(with(LightState::kShadow, strip(2, 4))).right());
  EXPECT_TRUE(judge(with(LightState::kLit, strip(0, 1, LightState::kShadow))).wrong());
  EXPECT_TRUE(judge(with(LightState::kShadow, strip(3, 4))).wrong());
}

// --- Area lights ---

/// Everything of one class taken out of a right result, and what is left said to be all.
TEST(SharedArea, ListedClassesOfSoups) {
  using enum LightState;
  unsigned judged = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const BuiltScene built = lattice_area_soup(seed, 6, 4);
    const ExactAnswer answer(built.scene, built.prepared);
    for (const LightState listed : {kLit, kPenumbra, kUmbra}) {
      Claims claims = exact_candidate(answer);
      ClaimedLight& light = claims.lights[0];
      light.listed = {listed};
      std::size_t kept = 0;
      for (ClaimedPolygon& polygon : light.polygons) {
        std::erase_if(polygon.fragments,
                      [&](const ClaimedFragment& f) { return f.state != listed; });
        kept += polygon.fragments.size();
      }
      EXPECT_EQ(certified(built, claims).verdict, Verdict::kIdentical) << seed;
      EXPECT_EQ(first_finding(built, claims), "") << seed;
      if (kept == 0) continue;
      ++judged;
      for (ClaimedPolygon& polygon : light.polygons) {
        if (polygon.fragments.empty()) continue;
        polygon.fragments.pop_back();
        break;
      }
      EXPECT_EQ(certified(built, claims).verdict, Verdict::kFailed) << seed;
      EXPECT_NE(first_finding(built, claims), "") << seed;
    }
  }
  EXPECT_GT(judged, 12u);
}

/// The fragments of one area light, as if they were told of several.
TEST(SharedArea, CombinedOfSoups) {
  unsigned changed = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const BuiltScene built = lattice_area_soup(seed, 6, 4);
    const ExactAnswer answer(built.scene, built.prepared);
    Claims claims = exact_candidate(answer);
    claims.combined.emplace();
    const std::string light = claims.lights[0].id;
    for (const ClaimedPolygon& polygon : claims.lights[0].polygons) {
      SharedPolygon& own = claims.combined->emplace_back();
      own.id = polygon.id;
      own.side = polygon.side;
      for (const ClaimedFragment& fragment : polygon.fragments) {
        SharedFragment& one = own.fragments.emplace_back();
        static_cast<ClaimedShape&>(one) = fragment;
        if (fragment.state == LightState::kLit) one.lit_by = {light};
        if (fragment.state == LightState::kPenumbra) one.penumbra_of = {light};
      }
    }
    EXPECT_EQ(certified(built, claims).verdict, Verdict::kIdentical) << seed;
    EXPECT_EQ(first_finding(built, claims), "") << seed;
    for (SharedPolygon& polygon : *claims.combined) {
      for (SharedFragment& fragment : polygon.fragments) {
        if (fragment.penumbra_of.empty()) continue;
        SharedFragment right = fragment;
        fragment.penumbra_of.clear();  // umbra, then
        EXPECT_EQ(certified(built, claims).verdict, Verdict::kFailed) << seed;
        EXPECT_NE(first_finding(built, claims), "") << seed;
        fragment.lit_by = {light};
        EXPECT_EQ(certified(built, claims).verdict, Verdict::kFailed) << seed;
        EXPECT_NE(first_finding(built, claims), "") << seed;
        fragment = right;
        ++changed;
        break;
      }
    }
  }
  EXPECT_GT(changed, 6u);
}

}  // namespace
}  // namespace gnomon::oracle
