// SPDX-License-Identifier: GPL-3.0-or-later
// The checker of claims under area lights accepts what is right and names each kind of lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gnomon/oracle/verdict.h"
#include "gnomon/oracle/witness_check.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

using testing::HasSubstr;

class AreaWitness : public testing::Test {
 protected:
  AreaWitness()
      : built_(SceneBuilder()
                   .polygon("floor", {{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}})
                   .polygon("lid", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}})
                   .polygon("wall", {{5, -4, 0}, {5, -4, 8}, {5, 4, 8}, {5, 4, 0}}, true)
                   .polygon("away", {{-5, -4, 0}, {-5, -4, 3}, {-5, 4, 3}, {-5, 4, 0}})
                   .area("panel", {{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}})
                   .build()),
        answer_(built_.scene, built_.prepared),
        good_(exact_candidate(answer_)) {}

  BuiltScene built_;
  ExactAnswer answer_;
  Claims good_;
};

TEST_F(AreaWitness, RightIsAccepted) {
  const WitnessReport report = check_witnesses(built_.scene, built_.prepared, good_);
  EXPECT_EQ(report.violations, 0u) << report.findings[0].text;
  EXPECT_GE(report.witnesses, 5u);
  EXPECT_EQ(report.polygons, 4u);
}

TEST_F(AreaWitness, EveryLieIsNamed) {
  const LightState lit = LightState::kLit, penumbra = LightState::kPenumbra,
                   umbra = LightState::kUmbra;
  Claims wrong = good_;
  fragment_of(wrong, 0, umbra).caster = "wall";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("'wall' does not hide all of the light"));

  wrong = good_;
  fragment_of(wrong, 0, penumbra).caster = "away";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("'away' does not hide part of the light"));

  wrong = good_;
  fragment_of(wrong, 0, penumbra).caster.clear();
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("a penumbra fragment names no caster"));

  wrong = good_;
  fragment_of(wrong, 0, umbra).caster.clear();
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("an umbra fragment names no caster"));

  wrong = good_;
  fragment_of(wrong, 0, umbra).reason = "behind-light";
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("'behind-light' does not hold"));

  wrong = good_;
  fragment_of(wrong, 0, penumbra).state = lit;
  EXPECT_THAT(first_finding(built_, wrong),
              HasSubstr("a lit fragment is in the penumbra of 'lid'"));

  wrong = good_;
  fragment_of(wrong, 0, penumbra).state = umbra;
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("does not hide all of the light"));

  wrong = good_;
  fragment_of(wrong, 0, umbra).state = penumbra;
  EXPECT_THAT(first_finding(built_, wrong),
              HasSubstr("a penumbra fragment is in the umbra of 'lid'"));
  wrong.lights[0].per_caster_umbra = false;
  EXPECT_EQ(first_finding(built_, wrong), "");

  wrong = good_;
  fragment_of(wrong, 2, umbra).state = lit;
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("a lit fragment reaches behind the light"));

  wrong = good_;
  fragment_of(wrong, 3, umbra).state = lit;
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("sees nothing of the light"));

  wrong = good_;
  fragment_of(wrong, 0, lit).state = LightState::kShadow;
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("an area light does not have"));

  wrong = good_;
  wrong.lights[0].polygons[0].umbra_fraction = mpq_class(1, 3);
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("umbra fraction is claimed as 1/3"));
  wrong.lights[0].polygons[0].umbra_fraction = mpq_class(65, 512);
  EXPECT_EQ(first_finding(built_, wrong), "");

  wrong = good_;
  wrong.lights[0].polygons.erase(wrong.lights[0].polygons.begin() + 1);
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("the polygon is missing"));

  wrong = good_;
  wrong.lights[0].polygons.push_back(wrong.lights[0].polygons[1]);
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("listed twice"));

  wrong = good_;
  wrong.lights.clear();
  EXPECT_THAT(first_finding(built_, wrong), HasSubstr("the light is missing"));
}

TEST(AreaWitnessSides, BothSidesAreListed) {
  const BuiltScene built =
      SceneBuilder()
          .polygon("wall", {{0, -1, 0}, {0, 1, 0}, {0, 1, 2}, {0, -1, 2}}, true)
          .area("panel", {{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}})
          .build();
  const ExactAnswer answer(built.scene, built.prepared);
  Claims candidate = exact_candidate(answer);
  ASSERT_EQ(candidate.lights[0].polygons.size(), 2u);
  EXPECT_EQ(check_witnesses(built.scene, built.prepared, candidate).violations, 0u);
  candidate.lights[0].polygons.pop_back();
  const WitnessReport report = check_witnesses(built.scene, built.prepared, candidate);
  ASSERT_EQ(report.violations, 1u);
  EXPECT_EQ(report.findings[0].text, "its back is missing");
}

TEST(AreaWitnessSoups, AgreesWithTheVerdict) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const BuiltScene built = lattice_area_soup(seed, 9, seed % 2 == 0 ? 4 : 2);
    const ExactAnswer answer(built.scene, built.prepared);
    const Claims candidate = exact_candidate(answer);
    const WitnessReport exact = check_witnesses(built.scene, built.prepared, candidate);
    EXPECT_EQ(exact.violations, 0u)
        << seed << " " << exact.findings[0].polygon << " " << exact.findings[0].text;
    Random random(seed);
    for (int i = 0; i < 4; ++i) {
      Claims wrong = candidate;
      ClaimedLight& light = wrong.lights[0];
      ClaimedPolygon& polygon = light.polygons[random.next() % light.polygons.size()];
      ClaimedFragment& fragment = polygon.fragments[random.next() % polygon.fragments.size()];
      fragment.reason.clear();
      const LightState others[] = {LightState::kLit, LightState::kPenumbra, LightState::kUmbra};
      LightState other = fragment.state;
      while (other == fragment.state) other = others[random.next() % 3];
      fragment.state = other;
      EXPECT_GT(check_witnesses(built.scene, built.prepared, wrong).violations, 0u) << seed;
      EXPECT_EQ(certify(answer, wrong, {})->verdict, Verdict::kFailed) << seed;
    }
  }
}

}  // namespace
}  // namespace gnomon::oracle
