// SPDX-License-Identifier: GPL-3.0-or-later
// Whole scenes certified: exact candidates are identical, and what is missing or unknown fails by
// name.
#include "gnomon/oracle/verdict.h"

#include <gtest/gtest.h>

#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

BuiltScene table() {
  return SceneBuilder()
      .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
      .polygon("quad", {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}})
      .sun("sun", {0, 0, 1})
      .build();
}

TEST(Verdict, ExactCandidatesAreIdenticalOnSoups) {
  std::uint64_t fragments = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const BuiltScene built = lattice_soup(seed, 14, 4);
    const ExactAnswer answer(built.scene, built.prepared);
    const Claims candidate = exact_candidate(answer);
    const Expected<Report> report = certify(answer, candidate, {});
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(report->verdict, Verdict::kIdentical) << seed << " " << report->reason;
    EXPECT_TRUE(report->problems.empty()) << seed;
    EXPECT_EQ(report->totals.invented + report->totals.lost, 0u);
    fragments += report->totals.fragments;
  }
  EXPECT_GT(fragments, 5000u);
}

TEST(Verdict, RoundedCandidatesAreWithinTolerance) {
  std::uint64_t within = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const BuiltScene built = lattice_soup(seed, 14, 4);
    const ExactAnswer answer(built.scene, built.prepared);
    Claims candidate = exact_candidate(answer);
    for (ClaimedLight& light : candidate.lights) {
      for (ClaimedPolygon& polygon : light.polygons) {
        for (ClaimedFragment& fragment : polygon.fragments) {
          for (RationalPoint& point : fragment.loop) {
            for (mpq_class& coordinate : point) coordinate = coordinate.get_d();
          }
        }
      }
    }
    const Expected<Report> report = certify(answer, candidate, {});
    ASSERT_TRUE(report.has_value());
    EXPECT_NE(report->verdict, Verdict::kFailed)
        << seed << " " << report->reason << " width " << report->totals.width.upper;
    EXPECT_FALSE(report->oracle_fault);
    if (report->verdict == Verdict::kWithinTolerance) {
      ++within;
      CertifyOptions strict;
      strict.strict = true;
      EXPECT_EQ(certify(answer, candidate, strict)->verdict, Verdict::kFailed);
    }
  }
  EXPECT_GT(within, 20u);
}

TEST(Verdict, MissingAndUnknown) {
  const BuiltScene built = table();
  const ExactAnswer answer(built.scene, built.prepared);
  const Claims good = exact_candidate(answer);
  EXPECT_EQ(certified(built, good).verdict, Verdict::kIdentical);

  Claims missing = good;
  missing.lights[0].polygons.pop_back();
  EXPECT_EQ(certified(built, missing).reason, "light 'sun': polygon 'quad' (front) is missing");
  CertifyOptions subset;
  subset.subset = true;
  EXPECT_EQ(certified(built, missing, subset).verdict, Verdict::kIdentical);

  Claims no_light = good;
  no_light.lights.clear();
  EXPECT_EQ(certified(built, no_light).reason, "light 'sun' is missing");

  Claims unknown = good;
  unknown.lights[0].polygons[0].id = "flor";
  EXPECT_EQ(certified(built, unknown, subset).reason,
            "light 'sun': no polygon 'flor' in the scene");

  Claims twice = good;
  twice.lights[0].polygons.push_back(twice.lights[0].polygons[0]);
  EXPECT_EQ(certified(built, twice).reason, "light 'sun': polygon 'floor' (front) is listed twice");

  Claims penumbra = good;
  penumbra.lights[0].polygons[0].fragments[0].state = LightState::kPenumbra;
  EXPECT_EQ(certified(built, penumbra).verdict, Verdict::kFailed);

  Claims background = good;
  background.lights[0].background = LightState::kLit;
  background.lights[0].polygons.pop_back();
  std::erase_if(background.lights[0].polygons[0].fragments,
                [](const ClaimedFragment& f) { return f.state == LightState::kLit; });
  EXPECT_EQ(certified(built, background).verdict, Verdict::kIdentical);
  background.lights[0].background = LightState::kShadow;
  EXPECT_EQ(certified(built, background).verdict, Verdict::kFailed);
}

TEST(Verdict, SwappedClassHasAWitness) {
  const BuiltScene built = table();
  const ExactAnswer answer(built.scene, built.prepared);
  Claims wrong = exact_candidate(answer);
  for (ClaimedFragment& fragment : wrong.lights[0].polygons[0].fragments) {
    fragment.state = LightState::kLit;
  }
  const Report report = certified(built, wrong);
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  ASSERT_TRUE(report.worst.has_value());
  EXPECT_EQ(report.worst->light, "sun");
  EXPECT_EQ(report.worst->polygon, "floor");
  EXPECT_EQ(report.worst->found, LightState::kLit);
  EXPECT_EQ(report.worst->truth, LightState::kShadow);
  EXPECT_EQ(report.worst->caster, "quad");
  EXPECT_EQ(report.worst->text, "found lit, truly shadow behind 'quad'");
  EXPECT_EQ(report.worst->point[2], 0);
  EXPECT_GT(report.worst->nearest[0], 1);
  EXPECT_LT(report.worst->nearest[0], 2);
  // The quad's shadow: a disc of diameter 1 fits.
  EXPECT_LE(report.worst->width.lower, 1);
  EXPECT_GE(report.worst->width.upper, 1);
  EXPECT_LT(report.worst->width.upper, 1.1);
  ASSERT_TRUE(report.worst->clearance.has_value());
  EXPECT_LE(*report.worst->clearance, 1.0000001);  // half a unit from an edge: twice that
  EXPECT_EQ(report.totals.lost, 1u);
  const PolygonComparison& floor = report.lights[0].polygons[0];
  EXPECT_EQ(floor.misclassified.exact, mpq_class(1, 16));
  EXPECT_TRUE(floor.misclassified.area.contains(1));
}

TEST(Verdict, IllConditionedIsCountedApart) {
  // A window meant to lie in a wall, behind it by 1e-10.
  const BuiltScene built =
      SceneBuilder()
          .polygon("wall", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
          .polygon("window", {{1, 1, -1e-10}, {2, 1, -1e-10}, {2, 2, -1e-10}, {1, 2, -1e-10}})
          .sun("sun", {0, 1, 1})
          .build();
  const ExactAnswer answer(built.scene, built.prepared);
  Claims wrong = exact_candidate(answer);
  for (ClaimedFragment& fragment : wrong.lights[0].polygons[1].fragments) {
    EXPECT_EQ(fragment.state, LightState::kShadow);
    fragment.state = LightState::kLit;
  }
  EXPECT_EQ(certified(built, wrong).verdict, Verdict::kFailed);
  CertifyOptions options;
  options.clearance = 1e-9;
  const Report report = certified(built, wrong, options);
  EXPECT_EQ(report.verdict, Verdict::kWithinTolerance) << report.reason;
  EXPECT_EQ(report.totals.ill_conditioned_regions, 1u);
  options.clearance = 1e-11;
  EXPECT_EQ(certified(built, wrong, options).verdict, Verdict::kFailed);
}

TEST(Verdict, PointsAboveTheLimit) {
  const BuiltScene built = lattice_soup(5, 14, 4);
  const ExactAnswer answer(built.scene, built.prepared);
  Claims candidate = exact_candidate(answer);
  CertifyOptions options;
  options.most_pairs = 10;
  Report report = certified(built, candidate, options);
  EXPECT_TRUE(report.by_points);
  EXPECT_EQ(report.verdict, Verdict::kWithinTolerance) << report.reason;
  EXPECT_GT(report.points_checked, 100u);
  EXPECT_EQ(report.points_wrong, 0u);
  for (ClaimedLight& light : candidate.lights) {
    for (ClaimedPolygon& polygon : light.polygons) {
      for (ClaimedFragment& fragment : polygon.fragments) fragment.state = LightState::kLit;
    }
  }
  report = certified(built, candidate, options);
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_GT(report.points_wrong, 0u);
}

TEST(Verdict, Interrupted) {
  const BuiltScene built = table();
  const ExactAnswer answer(built.scene, built.prepared);
  const std::atomic<bool> stop{true};
  CertifyOptions options;
  options.interrupted = &stop;
  const Report report = *certify(answer, exact_candidate(answer), options);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(report.verdict, Verdict::kFailed);
}

TEST(Verdict, BadOptions) {
  const BuiltScene built = table();
  CertifyOptions options;
  options.tolerance = -1;
  EXPECT_FALSE(certify(built.scene, built.prepared, {}, options).has_value());
}

}  // namespace
}  // namespace gnomon::oracle
