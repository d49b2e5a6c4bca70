// SPDX-License-Identifier: GPL-3.0-or-later
// Candidates under area lights: what must be exact, what is accepted, and what is only a cost.
#include <gtest/gtest.h>

#include "gnomon/oracle/verdict.h"
#include "gnomon/oracle/witness_check.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

/// A floor whose nested squares are of these classes, from the outermost in.
Claims nested(const std::vector<std::pair<double, LightState>>& squares) {
  Claims candidate;
  candidate.name = "by hand";
  ClaimedLight light;
  light.id = "panel";
  ClaimedPolygon floor;
  floor.id = "floor";
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto [outer, shade] = squares[i];
    if (i + 1 == squares.size()) {
      floor.fragments.push_back(rectangle(shade, -outer, -outer, outer, outer));
      continue;
    }
    const double inner = squares[i + 1].first;
    floor.fragments.push_back(rectangle(shade, -outer, -outer, outer, -inner));
    floor.fragments.push_back(rectangle(shade, -outer, inner, outer, outer));
    floor.fragments.push_back(rectangle(shade, -outer, -inner, -inner, inner));
    floor.fragments.push_back(rectangle(shade, inner, -inner, outer, inner));
  }
  light.polygons.push_back(std::move(floor));
  candidate.lights.push_back(std::move(light));
  return candidate;
}

constexpr LightState kIsLit = LightState::kLit, kIsPenumbra = LightState::kPenumbra,
                     kIsUmbra = LightState::kUmbra;

/// Of polygons that are listed.
Report certified_subset(const BuiltScene& built, const Claims& candidate) {
  CertifyOptions options;
  options.subset = true;
  return certified(built, candidate, options);
}

class AreaVerdict : public testing::Test {
 protected:
  // Penumbra [-3, 3]^2, umbra [-1, 1]^2 of the whole lid.
  const BuiltScene whole_ = SceneBuilder()
                                .polygon("floor", kFloor)
                                .polygon("lid", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}})
                                .area("panel", kPanel)
                                .build();
};

TEST_F(AreaVerdict, ExactIsIdentical) {
  Claims candidate = nested({{8, kIsLit}, {3, kIsPenumbra}, {1, kIsUmbra}});
  for (const bool per_caster : {false, true}) {
    candidate.lights[0].per_caster_umbra = per_caster;
    const Report report = certified_subset(whole_, candidate);
    EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
    const PolygonComparison& floor = report.lights[0].polygons[0];
    EXPECT_EQ(floor.lit.exact, mpq_class(220) / 256);
    EXPECT_EQ(floor.penumbra.exact, mpq_class(32) / 256);
    EXPECT_EQ(floor.umbra.exact, mpq_class(4) / 256);
    EXPECT_TRUE(floor.missing_umbra.zero);
    EXPECT_TRUE(report.totals.umbra.contains(4));
    EXPECT_EQ(report.totals.invented + report.totals.lost, 0u);
  }
}

TEST_F(AreaVerdict, MissingUmbraIsACost) {
  Claims candidate = nested({{8, kIsLit}, {3, kIsPenumbra}});
  Report report = certified_subset(whole_, candidate);
  EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
  EXPECT_EQ(report.lights[0].polygons[0].missing_umbra.exact, mpq_class(4) / 256);
  EXPECT_TRUE(report.totals.missing_umbra.contains(4));
  EXPECT_EQ(report.totals.lost, 0u);
  candidate.lights[0].per_caster_umbra = true;
  report = certified_subset(whole_, candidate);
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(4) / 256);
  EXPECT_EQ(report.totals.lost, 1u);
  EXPECT_EQ(report.worst->text, "found penumbra, truly umbra behind 'lid'");
}

TEST_F(AreaVerdict, MissingPenumbraIsAnError) {
  const Report report =
      certified_subset(whole_, nested({{8, kIsLit}, {2, kIsPenumbra}, {1, kIsUmbra}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(20) / 256);
  EXPECT_EQ(report.worst->text, "found lit, truly penumbra of 'lid'");
}

TEST_F(AreaVerdict, TooMuchPenumbraIsAnError) {
  const Report report =
      certified_subset(whole_, nested({{8, kIsLit}, {4, kIsPenumbra}, {1, kIsUmbra}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(28) / 256);
}

TEST_F(AreaVerdict, TooMuchUmbraIsAnErrorThatSeesLight) {
  const Report report =
      certified_subset(whole_, nested({{8, kIsLit}, {3, kIsPenumbra}, {2, kIsUmbra}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(12) / 256);
  EXPECT_NE(report.worst->text.find("of the light is seen"), std::string::npos)
      << report.worst->text;
}

TEST_F(AreaVerdict, ClassesOfPointLightsAreUnknownHere) {
  const Report report =
      certified_subset(whole_, nested({{8, kIsLit}, {3, kIsPenumbra}, {1, LightState::kShadow}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.reason,
            "light 'panel': polygon 'floor' has a fragment of class 'shadow'; lit, penumbra or "
            "umbra was expected");
}

TEST_F(AreaVerdict, BackgroundIsAClassOfTheLight) {
  Claims candidate = nested({{3, kIsPenumbra}, {1, kIsUmbra}});
  candidate.lights[0].background = kIsLit;
  candidate.lights[0].polygons.push_back({});
  candidate.lights[0].polygons[1].id = "lid";
  EXPECT_EQ(certified_subset(whole_, candidate).verdict, Verdict::kIdentical);
  candidate.lights[0].background = kIsUmbra;
  EXPECT_EQ(certified_subset(whole_, candidate).verdict, Verdict::kFailed);
}

// Strips along y, so that only x counts: a light at z = 4 over a floor at z = 0.
constexpr double kLong = 20;
std::vector<Triple> strip(double x0, double x1, double z) {
  return {{x0, -kLong, z}, {x1, -kLong, z}, {x1, kLong, z}, {x0, kLong, z}};
}
SceneBuilder strips() {
  return SceneBuilder()
      .polygon("floor", {{-8, -1, 0}, {8, -1, 0}, {8, 1, 0}, {-8, 1, 0}})
      .area("panel", kPanel);
}
Claims floor_of(const std::vector<std::pair<double, LightState>>& from) {
  Claims candidate;
  candidate.lights.emplace_back().id = "panel";
  ClaimedPolygon& floor = candidate.lights[0].polygons.emplace_back();
  floor.id = "floor";
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double end = i + 1 < from.size() ? from[i + 1].first : 8;
    floor.fragments.push_back(rectangle(from[i].second, from[i].first, -1, end, 1));
  }
  return candidate;
}

TEST(AreaVerdictStrips, AUnionWhosePlanesAreNotContinuedLosesPenumbra) {
  // Figure 6 of the 1992 paper. The lower strip's penumbra is x in [-1/3, 1]; the upper one's,
  // [-5, 2], comes out of it on the other side. Entered only where its strip itself lies, in front
  // of the first volume's first plane, it ends there: ]1, 2] is lost.
  const BuiltScene built =
      strips().polygon("lower", strip(0, 0.5, 1)).polygon("upper", strip(-0.5, -0.25, 3)).build();
  EXPECT_EQ(
      certified_subset(built, floor_of({{-8, kIsLit}, {-5, kIsPenumbra}, {2, kIsLit}})).verdict,
      Verdict::kIdentical);
  const Claims wrong = floor_of({{-8, kIsLit}, {-5, kIsPenumbra}, {1, kIsLit}});
  const Report report = certified_subset(built, wrong);
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  const PolygonComparison& floor = report.lights[0].polygons[0];
  EXPECT_EQ(floor.misclassified.exact, mpq_class(1, 16));
  EXPECT_TRUE(floor.missing_umbra.zero);
  EXPECT_EQ(report.worst->text, "found lit, truly penumbra of 'upper'");
  WitnessOptions options;
  options.subset = true;
  const WitnessReport found = check_witnesses(built.scene, built.prepared, wrong, options);
  EXPECT_TRUE(std::any_of(found.findings.begin(), found.findings.end(), [](const auto& finding) {
    return finding.text == "a lit fragment is in the penumbra of 'upper'";
  }));
}

TEST(AreaVerdictStrips, DeepUmbraMayBeClaimed) {
  // Figure 4(f): alone the strips hide all from x in [-3, -1/2] and [1/3, 7/3]; both together from
  // [-1/4, 7/3] too. Penumbra is [-5, 3].
  const BuiltScene built =
      strips().polygon("upper", strip(-2, 0.25, 2)).polygon("lower", strip(0, 2, 1)).build();
  Claims candidate = floor_of({{-8, kIsLit},
                               {-5, kIsPenumbra},
                               {-3, kIsUmbra},
                               {-0.5, kIsPenumbra},
                               {-0.125, kIsUmbra},
                               {2.25, kIsPenumbra},
                               {3, kIsLit}});
  Report report = certified_subset(built, candidate);
  EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
  // [2.25, 7/3] was called penumbra.
  EXPECT_EQ(report.lights[0].polygons[0].missing_umbra.exact, mpq_class(1, 192));
  candidate.lights[0].per_caster_umbra = true;
  EXPECT_EQ(certified_subset(built, candidate).verdict, Verdict::kFailed);
  // Up to -3/8 some of the light is seen from a part of it.
  candidate.lights[0].per_caster_umbra = false;
  candidate.lights[0].polygons[0].fragments[3] = rectangle(kIsPenumbra, -0.5, -1, -0.375, 1);
  candidate.lights[0].polygons[0].fragments[4] = rectangle(kIsUmbra, -0.375, -1, 2.25, 1);
  report = certified_subset(built, candidate);
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_GE(report.lights[0].polygons[0].misclassified.fraction.upper, 0.125 / 16);
  EXPECT_LE(report.lights[0].polygons[0].misclassified.fraction.upper, 0.2 / 16);
  EXPECT_EQ(report.worst->found, kIsUmbra);
}

TEST(AreaVerdictStrips, DeepUmbraOfASheetMayBeClaimed) {
  // The lid in four quarters: its umbra is deep, and of no quarter alone.
  SceneBuilder builder;
  builder.polygon("floor", kFloor).area("panel", kPanel);
  for (const double x : {-1.0, 0.0}) {
    for (const double y : {-1.0, 0.0}) {
      builder.polygon("lid" + std::to_string(int(x)) + std::to_string(int(y)),
                      {{x, y, 2}, {x + 1, y, 2}, {x + 1, y + 1, 2}, {x, y + 1, 2}});
    }
  }
  const BuiltScene built = builder.build();
  Claims candidate = nested({{8, kIsLit}, {3, kIsPenumbra}, {1, kIsUmbra}});
  const Report report = certified_subset(built, candidate);
  EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
  EXPECT_TRUE(report.lights[0].polygons[0].umbra.zero);
  candidate.lights[0].per_caster_umbra = true;
  EXPECT_EQ(certified_subset(built, candidate).verdict, Verdict::kFailed);
}

TEST(AreaVerdictSoups, ExactCandidatesAreIdentical) {
  std::uint64_t fragments = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const BuiltScene built = lattice_area_soup(seed, 9, seed % 2 == 0 ? 4 : 2);
    const ExactAnswer answer(built.scene, built.prepared);
    Claims candidate = exact_candidate(answer);
    for (const bool per_caster : {true, false}) {
      candidate.lights[0].per_caster_umbra = per_caster;
      const Expected<Report> report = certify(answer, candidate, {});
      ASSERT_TRUE(report.has_value());
      EXPECT_EQ(report->verdict, Verdict::kIdentical) << seed << " " << report->reason;
      EXPECT_TRUE(report->problems.empty()) << seed;
      EXPECT_EQ(report->totals.invented + report->totals.lost, 0u) << seed;
      EXPECT_TRUE(report->totals.missing_umbra.is_zero());
      fragments += report->totals.fragments;
    }
    CertifyOptions points;
    points.most_pairs = 1;
    const Report by_points = *certify(answer, candidate, points);
    EXPECT_TRUE(by_points.by_points);
    EXPECT_EQ(by_points.points_wrong, 0u) << seed << " " << by_points.reason;
    // One class changed is found, by regions and as a rule by points.
    Random random(seed);
    candidate.lights[0].per_caster_umbra = true;
    ClaimedLight& light = candidate.lights[0];
    ClaimedPolygon& polygon = light.polygons[random.next() % light.polygons.size()];
    ClaimedFragment& fragment = polygon.fragments[random.next() % polygon.fragments.size()];
    fragment.state = fragment.state == kIsUmbra ? kIsPenumbra : kIsUmbra;
    EXPECT_EQ(certify(answer, candidate, {})->verdict, Verdict::kFailed) << seed;
  }
  EXPECT_GT(fragments, 4000u);
}

TEST(AreaVerdictMixed, LightsOfEveryKind) {
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", kFloor)
          .polygon("lid", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}}, true)
          .point("lamp", {0, 0, 4})
          .area("panel", kPanel)
          .sun("sun", {0, 1, 2})
          .build();
  const ExactAnswer answer(built.scene, built.prepared);
  Claims candidate = exact_candidate(answer);
  const Report report = *certify(answer, candidate, {});
  EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
  ASSERT_EQ(report.lights.size(), 3u);
  EXPECT_TRUE(report.notes.empty());
  candidate.lights.erase(candidate.lights.begin() + 1);
  EXPECT_EQ(certify(answer, candidate, {})->reason, "light 'panel' is missing");
}

}  // namespace
}  // namespace gnomon::oracle
