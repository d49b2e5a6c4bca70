// SPDX-License-Identifier: GPL-3.0-or-later
// The checker of claims accepts what is right and names each kind of lie.
#include "gnomon/oracle/witness_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gnomon/oracle/prepared_check.h"
#include "gnomon/oracle/verdict.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

using testing::HasSubstr;

class WitnessCheck : public testing::Test {
 protected:
  WitnessCheck()
      : built_(SceneBuilder()
                   .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                   .polygon("lid", {{0, 0, 1}, {2, 0, 1}, {2, 4, 1}, {0, 4, 1}})
                   .polygon("under", {{0, 0, -1}, {0, 1, -1}, {1, 1, -1}, {1, 0, -1}})
                   .polygon("upright", {{3, 0, 2}, {3, 1, 2}, {3, 1, 3}, {3, 0, 3}})
                   .sun("sun", {0, 0, 1})
                   .build()),
        answer_(built_.scene, built_.prepared),
        good_(exact_candidate(answer_)) {}

  BuiltScene built_;
  ExactAnswer answer_;
  Claims good_;
};

TEST_F(WitnessCheck, RightIsAccepted) {
  const WitnessReport report = check_witnesses(built_.scene, built_.prepared, good_);
  EXPECT_EQ(report.violations, 0u) << report.findings[0].text;
  EXPECT_EQ(report.polygons, 4u);
  EXPECT_GE(report.witnesses, 3u);
}

/// Neither of two coplanar polygons shadows the other: what lies in the plane of a caster is on no
/// side of it, also where rounding has put it behind.
TEST(WitnessCheckCoplanar, ACasterInThePlaneShadowsNothing) {
  const BuiltScene built = SceneBuilder()
                               .polygon("a", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                               .polygon("b", {{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}})
                               .sun("sun", {0, 0, 1})
                               .build();
  const ExactAnswer answer(built.scene, built.prepared);
  const Claims good = exact_candidate(answer);
  EXPECT_EQ(first_finding(built, good), "");
  Claims wrong = good;
  ClaimedFragment& fragment = wrong.lights[0].polygons[1].fragments[0];
  fragment.state = LightState::kShadow;
  fragment.caster = "a";
  EXPECT_THAT(first_finding(built, wrong), HasSubstr("'a' does not shadow all"));
  Claims rounded = good;
  for (ClaimedFragment& own : rounded.lights[0].polygons[1].fragments) {
    own.exact = false;
    for (RationalPoint& point : own.loop) point[2] = mpq_class(-1, mpz_class(1) << 50);
  }
  EXPECT_EQ(first_finding(built, rounded), "");
}

TEST_F(WitnessCheck, EveryLieIsNamed) {
  Claims wrong = good_;
  fragment_of(wrong, 0, LightState::kShadow).caster = "upright";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("'upright' does not shadow all"));

  wrong = good_;
  fragment_of(wrong, 0, LightState::kShadow).caster = "nobody";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("no caster 'nobody'"));

  wrong = good_;
  fragment_of(wrong, 0, LightState::kShadow).caster.clear();
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("names no caster"));

  wrong = good_;
  fragment_of(wrong, 0, LightState::kShadow).reason = "faces-away";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("'faces-away' does not hold"));

  wrong = good_;
  fragment_of(wrong, 0, LightState::kShadow).state = LightState::kLit;
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("shadowed by 'lid'"));

  wrong = good_;
  wrong.lights[0].polygons[2].fragments[0].state = LightState::kLit;
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("does not face the light"));

  wrong = good_;
  wrong.lights[0].polygons[3].fragments[0].reason = "faces-away";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("does not hold"));

  wrong = good_;
  wrong.lights[0].polygons[0].lit_fraction = mpq_class(1, 3);
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("claimed as 1/3"));
  wrong.lights[0].polygons[0].lit_fraction = mpq_class(1, 2);
  EXPECT_EQ(first_finding(built_, wrong), "");

  wrong = good_;
  for (RationalPoint& point : fragment_of(wrong, 0, LightState::kLit).loop)
    point[2] += mpq_class(1, 1000000);
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("plane"));

  wrong = good_;
  for (RationalPoint& point : fragment_of(wrong, 0, LightState::kLit).loop)
    point[0] += mpq_class(1, 1000000);
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("leaves the polygon"));

  wrong = good_;
  wrong.lights[0].polygons[0].fragments.push_back(wrong.lights[0].polygons[0].fragments[0]);
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("do not add up"));

  wrong = good_;
  wrong.lights[0].polygons.pop_back();
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("missing"));

  wrong = good_;
  wrong.lights[0].id = "moon";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("no such light"));
}

TEST_F(WitnessCheck, AgreesWithTheVerdictOnSoups) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const BuiltScene built = lattice_soup(seed, 12, 4);
    EXPECT_TRUE(check_prepared(built.scene, built.prepared).empty()) << seed;
    const ExactAnswer answer(built.scene, built.prepared);
    Claims candidate = exact_candidate(answer);
    const WitnessReport exact = check_witnesses(built.scene, built.prepared, candidate);
    EXPECT_EQ(exact.violations, 0u)
        << seed << " " << exact.findings[0].polygon << " " << exact.findings[0].text;
    for (ClaimedLight& light : candidate.lights) {
      for (ClaimedPolygon& polygon : light.polygons) {
        for (ClaimedFragment& fragment : polygon.fragments) {
          fragment.exact = false;
          for (RationalPoint& point : fragment.loop) {
            for (mpq_class& coordinate : point) coordinate = coordinate.get_d();
          }
        }
      }
    }
    const WitnessReport rounded = check_witnesses(built.scene, built.prepared, candidate);
    EXPECT_EQ(rounded.violations, 0u)
        << seed << " " << rounded.findings[0].polygon << " " << rounded.findings[0].text;
    // One class changed: the checker and the overlay must both object.
    Random random(seed);
    for (int i = 0; i < 5; ++i) {
      Claims wrong = exact_candidate(answer);
      ClaimedLight& light = wrong.lights[random.next() % wrong.lights.size()];
      ClaimedPolygon& polygon = light.polygons[random.next() % light.polygons.size()];
      ClaimedFragment& fragment = polygon.fragments[random.next() % polygon.fragments.size()];
      fragment.reason.clear();
      fragment.state = fragment.state == LightState::kLit ? LightState::kShadow : LightState::kLit;
      EXPECT_GT(check_witnesses(built.scene, built.prepared, wrong).violations, 0u) << seed;
      EXPECT_EQ(certify(answer, wrong, {})->verdict, Verdict::kFailed) << seed;
    }
  }
}

TEST(PreparedCheck, FindsWhatIsWrong) {
  Scene scene =
      SceneBuilder()
          .polygon("L", {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}})
          .polygon("bent", {{0, 0, 1}, {4, 0, 1}, {4, 4, 2}, {0, 4, 1}})
          .polygon("tri", {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}})
          .sun("sun", {0, 0, 1})
          .build()
          .scene;
  const PreparedScene good = *prepare(scene);
  EXPECT_TRUE(check_prepared(scene, good).empty());

  PreparedScene wrong = good;
  wrong.parts[0].flipped = !wrong.parts[0].flipped;
  EXPECT_FALSE(check_prepared(scene, wrong).empty());

  wrong = good;
  std::swap(wrong.loop_vertices[wrong.parts[0].first],
            wrong.loop_vertices[wrong.parts[0].first + 1]);
  EXPECT_FALSE(check_prepared(scene, wrong).empty());

  wrong = good;  // a part is lost
  ASSERT_EQ(wrong.first_part[1], 2u);
  wrong.parts.erase(wrong.parts.begin() + 1);
  for (std::size_t p = 1; p < wrong.first_part.size(); ++p) --wrong.first_part[p];
  const std::vector<PreparedFinding> found = check_prepared(scene, wrong);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].polygon, "L");
  EXPECT_EQ(found[0].text, "the parts do not tile the polygon");

  wrong = good;
  wrong.geometry.origin[0] += 1;
  EXPECT_FALSE(check_prepared(scene, wrong).empty());

  wrong = good;
  wrong.parts.back().casts = false;
  EXPECT_FALSE(check_prepared(scene, wrong).empty());
}

// Found by the fuzzer `prepare`: such a polygon is dropped, and was called missing.
TEST(PreparedCheck, HolesMayFillAPolygon) {
  Scene scene = SceneBuilder()
                    .polygon("full", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                    .sun("sun", {0, 0, 1})
                    .build()
                    .scene;
  scene.polygons[0].holes = {{3, 2, 1, 0}};
  const PreparedScene prepared = *prepare(scene);
  EXPECT_TRUE(prepared.parts.empty());
  EXPECT_TRUE(check_prepared(scene, prepared).empty());

  // A hole that leaves some of it does not explain that it is gone.
  scene.polygons[0].holes = {{2, 1, 0}};
  const std::vector<PreparedFinding> found = check_prepared(scene, prepared);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].text, "the parts do not tile the polygon");
}

}  // namespace
}  // namespace gnomon::oracle
