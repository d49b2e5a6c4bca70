// SPDX-License-Identifier: GPL-3.0-or-later
// Samples judged: what is true at a point, by the definition; points on borders, on edges, in the
// light's plane; points off their polygons and without one; shares of area lights.
#include "gnomon/oracle/sample_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "gnomon/oracle/area_visibility.h"
#include "gnomon/oracle/visibility.h"
#include "gnomon/scene/generate.h"
#include "oracle/geometry/nearest_place.h"
#include "oracle/judge/near_border.h"
#include "oracle/visibility/area_sight.h"
#include "oracle/visibility/point_sight.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

RationalPoint rational(const mpq_class& x, const mpq_class& y, const mpq_class& z) {
  return {x, y, z};
}

Sample sample_at(const RationalPoint& point, const mpq_class& visible,
                 std::optional<std::uint32_t> polygon = 0) {
  Sample sample;
  sample.point = point;
  sample.visible = visible;
  sample.polygon = polygon;
  return sample;
}

SampleOutcome outcome(const BuiltScene& built, const Sample& sample, SampleOptions options = {}) {
  return SampleJudge(built.prepared, options).judge(sample).outcome;
}

/// A floor of 8 by 8 with a square over it, and a lamp twice as high over its middle: the shadow is
/// that of [-1, 1]^2, from -2 to 2.
SceneBuilder square_over_floor() {
  return SceneBuilder()
      .polygon("floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}})
      .polygon("square", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}})
      .point("lamp", {0, 0, 4});
}

TEST(SampleJudge, DecidesLightShadowAndBorder) {
  const BuiltScene built = square_over_floor().build();
  const mpq_class hair(1, mpz_class(1) << 90);
  for (const int seen : {0, 1}) {
    const auto at = [&](const mpq_class& x, const mpq_class& y) {
      return outcome(built, sample_at(rational(x, y, 0), seen));
    };
    const auto lit = seen == 1 ? SampleOutcome::kRight : SampleOutcome::kWrong;
    const auto dark = seen == 0 ? SampleOutcome::kRight : SampleOutcome::kWrong;
    EXPECT_EQ(at(3, 1), lit);
    EXPECT_EQ(at(0, 0), dark);
    EXPECT_EQ(at(2 - hair, 1), dark);
    EXPECT_EQ(at(2 + hair, 1), lit);
    EXPECT_EQ(at(2, 1), SampleOutcome::kOnBorder);
    EXPECT_EQ(at(2, 2), SampleOutcome::kOnBorder);
    EXPECT_EQ(at(2, mpq_class(5, 2)), lit);  // on the line of a border, beyond its end
    EXPECT_EQ(at(4, 4), lit);                // a corner of the floor
  }
}

TEST(SampleJudge, ALoneLitPolygonIsLitEverywhere) {
  const BuiltScene built = SceneBuilder()
                               .polygon("quad", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                               .point("lamp", {1, 1, 3})
                               .build();
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 4; ++y) {
      EXPECT_EQ(outcome(built, sample_at(rational(x, y, 0), 1)), SampleOutcome::kRight);
      EXPECT_EQ(outcome(built, sample_at(rational(x, y, 0), 0)), SampleOutcome::kWrong);
    }
  }
}

TEST(SampleJudge, NothingLeaksThroughEdgesThatCastersShare) {
  // Two squares that share an edge right above the floor's middle line, and a third that only
  // touches it in a T-junction.
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}})
                               .polygon("left", {{-2, -1, 2}, {0, -1, 2}, {0, 1, 2}, {-2, 1, 2}})
                               .polygon("right", {{0, -1, 2}, {2, -1, 2}, {2, 0, 2}, {0, 0, 2}})
                               .polygon("above", {{0, 0, 2}, {2, 0, 2}, {2, 1, 2}, {0, 1, 2}})
                               .point("lamp", {0, 0, 4})
                               .build();
  const auto at = [&](const mpq_class& x, const mpq_class& y) {
    return SampleJudge(built.prepared, {}).judge(sample_at(rational(x, y, 0), 1));
  };
  EXPECT_EQ(at(0, 1).outcome, SampleOutcome::kWrong);
  EXPECT_TRUE(at(0, 1).caster);
  EXPECT_EQ(at(0, 0).outcome, SampleOutcome::kWrong);  // the T-junction itself
  EXPECT_EQ(at(1, 0).outcome, SampleOutcome::kWrong);
  EXPECT_EQ(at(0, 2).outcome, SampleOutcome::kOnBorder);
  EXPECT_EQ(at(0, 3).outcome, SampleOutcome::kRight);
}

TEST(SampleJudge, AtTheFootOfAWallTheSideOfThePolygonCounts) {
  const BuiltScene built = SceneBuilder()
                               .polygon("before", {{0, -4, 0}, {4, -4, 0}, {4, 0, 0}, {0, 0, 0}})
                               .polygon("behind", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                               .polygon("through", {{0, -4, 0}, {4, -4, 0}, {4, 4, 0}, {0, 4, 0}})
                               .polygon("wall", {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}})
                               .sun("sun", {0, -1, 1})
                               .build();
  const RationalPoint foot = rational(2, 0, 0);
  EXPECT_EQ(outcome(built, sample_at(foot, 1, 0)), SampleOutcome::kRight);
  EXPECT_EQ(outcome(built, sample_at(foot, 0, 1)), SampleOutcome::kRight);
  EXPECT_EQ(outcome(built, sample_at(foot, 1, 1)), SampleOutcome::kWrong);
  EXPECT_EQ(outcome(built, sample_at(foot, 1, 2)), SampleOutcome::kOnBorder);
  EXPECT_EQ(outcome(built, sample_at(foot, 1, 3)), SampleOutcome::kRight);  // the wall itself
}

TEST(SampleJudge, SidesThatDoNotFaceTheLightAndCoplanarCasters) {
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
          .polygon("tile", {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}})
          .polygon("away", {{0, 0, 1}, {0, 4, 1}, {4, 4, 1}, {4, 0, 1}}, false)
          .polygon("edge-on", {{3, 0, 0}, {3, 4, 0}, {3, 4, 4}, {3, 0, 4}}, true)
          .polygon("both", {{9, 0, 0}, {12, 0, 0}, {12, 4, 0}, {9, 4, 0}}, true)
          .point("lamp", {3, 2, 9})
          .build();
  EXPECT_EQ(outcome(built, sample_at(rational(mpq_class(3, 2), mpq_class(3, 2), 0), 1, 0)),
            SampleOutcome::kRight);
  EXPECT_EQ(outcome(built, sample_at(rational(1, 1, 0), 1, 1)), SampleOutcome::kRight);
  EXPECT_EQ(outcome(built, sample_at(rational(1, 1, 1), 0, 2)), SampleOutcome::kRight);
  EXPECT_EQ(outcome(built, sample_at(rational(3, 1, 1), 0, 3)), SampleOutcome::kRight);
  EXPECT_EQ(outcome(built, sample_at(rational(3, 1, 1), 1, 3)), SampleOutcome::kWrong);
  Sample both = sample_at(rational(10, 1, 0), 1, 4);
  EXPECT_EQ(outcome(built, both), SampleOutcome::kRight);
  both.side = Side::kFront;
  EXPECT_EQ(outcome(built, both), SampleOutcome::kRight);
  both.side = Side::kBack;
  EXPECT_EQ(outcome(built, both), SampleOutcome::kWrong);
}

TEST(SampleJudge, WhatIsNoShareIsWrong) {
  const BuiltScene built = square_over_floor().build();
  for (const auto& seen : {mpq_class(1, 2), mpq_class(-1), mpq_class(2)}) {
    const JudgedSample judged =
        SampleJudge(built.prepared, {}).judge(sample_at(rational(3, 3, 0), seen));
    EXPECT_EQ(judged.outcome, SampleOutcome::kWrong);
    EXPECT_TRUE(judged.out_of_range);
  }
  Sample none = sample_at(rational(2, 0, 0), 1);  // on a border, where nothing else is wrong
  none.visible.reset();
  EXPECT_EQ(outcome(built, none), SampleOutcome::kWrong);
}

TEST(SampleJudge, TakesPointsToTheNearestOfTheirPolygon) {
  const BuiltScene built = SceneBuilder()
                               .polygon("slope", {{0, 0, 0}, {4, 0, 3}, {4, 4, 3}, {0, 4, 0}})
                               .polygon("shade", {{-2, -2, 9}, {1, -2, 9}, {1, 6, 9}, {-2, 6, 9}})
                               .sun("sun", {0, 0, 1})
                               .build();
  const SampleJudge judge(built.prepared, {});
  // The foot of (1, 2, 2) on z = 3/4 x is (8/5, 2, 6/5), a distance of 1 away, and lit.
  const JudgedSample above = judge.judge(sample_at(rational(1, 2, 2), 1));
  EXPECT_EQ(above.place, rational(mpq_class(8, 5), 2, mpq_class(6, 5)));
  EXPECT_GE(above.moved, 1);
  EXPECT_LE(above.moved, 1 + 1e-15);
  EXPECT_EQ(above.outcome, SampleOutcome::kRight);
  // Beyond an edge and beyond a corner.
  EXPECT_EQ(judge.judge(sample_at(rational(2, -5, mpq_class(3, 2)), 1)).place,
            rational(2, 0, mpq_class(3, 2)));
  const JudgedSample corner = judge.judge(sample_at(rational(-3, -4, 0), 0));
  EXPECT_EQ(corner.place, rational(0, 0, 0));
  EXPECT_GE(corner.moved, 5);
  EXPECT_EQ(corner.outcome, SampleOutcome::kRight);
  EXPECT_EQ(judge.judge(sample_at(rational(0, 0, 0), 0)).moved, 0);
}

TEST(SampleJudge, FindsThePolygonOfAPoint) {
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                               .polygon("shelf", {{1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1}})
                               .polygon("under", {{1, 1, 1}, {1, 3, 1}, {3, 3, 1}, {3, 1, 1}})
                               .sun("sun", {0, 0, 1})
                               .build();
  const SampleJudge judge(built.prepared, {.width = 0.01});
  const auto at = [&](double z, int seen) {
    return judge.judge(sample_at(oracle::at(2, 2, z), seen, std::nullopt));
  };
  EXPECT_EQ(at(0.25, 0).polygon, 0u);
  EXPECT_EQ(at(0.25, 0).outcome, SampleOutcome::kRight);
  // Of the shelf's two polygons the one that faces the light counts.
  EXPECT_EQ(at(1, 1).polygon, 1u);
  EXPECT_EQ(at(1, 1).outcome, SampleOutcome::kRight);
  EXPECT_EQ(at(1, 1).candidates, 1u);
  EXPECT_EQ(at(0.75, 1).polygon, 1u);
  // Two that face the light, of which one is in the shadow of the other.
  const BuiltScene close =
      SceneBuilder()
          .polygon("lower", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
          .polygon("upper", {{0, 0, 0.5}, {4, 0, 0.5}, {4, 4, 0.5}, {0, 4, 0.5}})
          .sun("sun", {0, 0, 1})
          .build();
  for (const int seen : {0, 1}) {
    const JudgedSample judged = SampleJudge(close.prepared, {.width = 0.01})
                                    .judge(sample_at(oracle::at(2, 2, 0.25), seen, std::nullopt));
    EXPECT_EQ(judged.outcome, SampleOutcome::kAmbiguous);
    EXPECT_EQ(judged.candidates, 2u);
  }
  EXPECT_EQ(outcome(close, sample_at(oracle::at(2, 2, 0.5), 1, std::nullopt), {.width = 0.01}),
            SampleOutcome::kRight);
}

TEST(SampleJudge, MissesWithinTheWidthOfABorderAreApart) {
  const BuiltScene built = square_over_floor().build();
  const auto judged = [&](double x, int seen, SampleOptions options) {
    return SampleJudge(built.prepared, options).judge(sample_at(at(x, 0.5, 0), seen));
  };
  EXPECT_EQ(judged(1.999, 1, {.width = 0.002}).outcome, SampleOutcome::kNearBorder);
  EXPECT_EQ(judged(1.999, 1, {.width = 0.0005}).outcome, SampleOutcome::kWrong);
  EXPECT_EQ(judged(2.001, 0, {.width = 0.002}).outcome, SampleOutcome::kNearBorder);
  EXPECT_EQ(judged(2.001, 0, {.width = 0.0005}).outcome, SampleOutcome::kWrong);
  EXPECT_EQ(judged(1.999, 1, {}).outcome, SampleOutcome::kWrong);
  const JudgedSample inside = judged(1.75, 1, {.width = 0.1});
  ASSERT_TRUE(inside.from_border);
  EXPECT_NEAR(*inside.from_border, 0.25, 1e-12);
  const JudgedSample outside = judged(2.75, 0, {.width = 0.1});
  ASSERT_TRUE(outside.from_border);
  EXPECT_NEAR(*outside.from_border, 0.75, 1e-12);
  // Moving a corner of the square by a little more than half of 0.001 is enough.
  EXPECT_EQ(judged(1.999, 1, {.clearance = 0.01}).outcome, SampleOutcome::kIllConditioned);
  EXPECT_EQ(judged(1.5, 1, {.clearance = 0.01}).outcome, SampleOutcome::kWrong);
}

TEST(SampleJudge, ALightFarAwayMakesBordersNoLessCertain) {
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}})
                               .polygon("square", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}})
                               .point("lamp", {0, 0, 0x1p40})
                               .build();
  const SampleJudge judge(built.prepared, {.width = 1e-9});
  const JudgedSample inside = judge.judge(sample_at(at(0.75, 0, 0), 1));
  EXPECT_NEAR(inside.from_border.value_or(0), 0.25, 1e-11);
  EXPECT_EQ(judge.judge(sample_at(at(1 - 1e-10, 0, 0), 1)).outcome, SampleOutcome::kNearBorder);
  EXPECT_EQ(judge.judge(sample_at(at(1 - 1e-8, 0, 0), 1)).outcome, SampleOutcome::kWrong);
}

TEST(SampleJudge, TheEdgeOfTwoShadowsTogetherIsNoBorder) {
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}})
                               .polygon("left", {{-2, -1, 2}, {0, -1, 2}, {0, 1, 2}, {-2, 1, 2}})
                               .polygon("right", {{0, -1, 2}, {2, -1, 2}, {2, 1, 2}, {0, 1, 2}})
                               .point("lamp", {0, 0, 4})
                               .build();
  for (const double x : {0.0, 1e-5}) {
    EXPECT_EQ(outcome(built, sample_at(at(x, 0.5, 0), 1), {.width = 0.01}), SampleOutcome::kWrong);
  }
  EXPECT_EQ(outcome(built, sample_at(at(0, 1.995, 0), 1), {.width = 0.01}),
            SampleOutcome::kNearBorder);
}

TEST(SampleJudge, FarFromTheOriginNothingChanges) {
  const double far = 0x1p40;
  const auto moved = [&](double x, double y, double z) {
    return Triple{x + far, y - far, z + far};
  };
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", {moved(-4, -4, 0), moved(4, -4, 0), moved(4, 4, 0), moved(-4, 4, 0)})
          .polygon("square", {moved(-1, -1, 2), moved(1, -1, 2), moved(1, 1, 2), moved(-1, 1, 2)})
          .point("lamp", moved(0, 0, 4))
          .build();
  const auto at = [&](double x, int seen, SampleOptions options = {}) {
    const Triple point = moved(x, 0.5, 0);
    return outcome(built, sample_at(oracle::at(point[0], point[1], point[2]), seen), options);
  };
  EXPECT_EQ(at(2 - 0x1p-10, 0), SampleOutcome::kRight);
  EXPECT_EQ(at(2 + 0x1p-10, 1), SampleOutcome::kRight);
  EXPECT_EQ(at(2, 1), SampleOutcome::kOnBorder);
  EXPECT_EQ(at(2 + 0x1p-10, 0, {.width = 0x1p-9}), SampleOutcome::kNearBorder);
  EXPECT_EQ(at(2 + 0x1p-10, 0, {.width = 0x1p-11}), SampleOutcome::kWrong);
}

TEST(SampleJudge, SharesOfAnAreaLightAreExact) {
  // The square hides the strip of the panel beyond x = 0 from the floor's middle.
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, true)
          .polygon("half", {{0, -9, 2}, {9, -9, 2}, {9, 9, 2}, {0, 9, 2}})
          .polygon("wall", {{-4, -4, 0}, {-4, 4, 0}, {-4, 4, 1}, {-4, -4, 1}})
          .area("panel", {{-1, -1, 4}, {-1, 1, 4}, {2, 1, 4}, {2, -1, 4}})
          .build();
  const SampleJudge judge(built.prepared, {.width = 0.01});
  const auto judged = [&](const RationalPoint& point, const mpq_class& seen, double allowed = 0,
                          std::uint32_t polygon = 0) {
    Sample sample = sample_at(point, seen, polygon);
    sample.allowed = allowed;
    return judge.judge(sample);
  };
  const mpq_class third(1, 3);
  EXPECT_EQ(judged(rational(0, 0, 0), third).truth, third);
  EXPECT_EQ(judged(rational(0, 0, 0), third).outcome, SampleOutcome::kRight);
  EXPECT_EQ(judged(rational(0, 0, 0), mpq_class(33, 100), 0.005).outcome, SampleOutcome::kRight);
  EXPECT_EQ(judged(rational(0, 0, 0), mpq_class(33, 100), 0.001).outcome, SampleOutcome::kWrong);
  EXPECT_EQ(judged(rational(0, 0, 0), mpq_class(33, 100)).caster, 1u);
  // From x the strip begins at -x: (1 + x) / 3 seen... less where the point is farther right.
  EXPECT_EQ(judged(rational(mpq_class(1, 2), 0, 0), 0).truth, mpq_class(1, 6));
  EXPECT_EQ(judged(rational(1, 0, 0), 0).outcome, SampleOutcome::kRight);
  EXPECT_EQ(judged(rational(-2, 0, 0), 1).outcome, SampleOutcome::kRight);
  // The back of the floor sees nothing, and a place on the wall's foot jumps.
  Sample back = sample_at(rational(-2, 0, 0), 1);
  back.side = Side::kBack;
  EXPECT_EQ(judge.judge(back).outcome, SampleOutcome::kWrong);
  // The upper side of `half` is before half of the panel and hidden by nothing.
  EXPECT_EQ(judged(rational(1, 0, 2), 1, 0, 1).outcome, SampleOutcome::kRight);
}

TEST(SampleJudge, SharesJumpWhereACasterIsTouched) {
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}})
          .polygon("wall", {{0, -9, 0}, {0, 9, 0}, {0, 9, 9}, {0, -9, 9}}, true)
          .area("panel", {{1, -1, 4}, {1, 1, 4}, {3, 1, 4}, {3, -1, 4}})
          .build();
  const SampleJudge judge(built.prepared, {.width = 0.01});
  const auto at = [&](double x, int seen) {
    return judge.judge(sample_at(oracle::at(x, 0, 0), seen));
  };
  for (const int seen : {0, 1}) {
    EXPECT_EQ(at(0, seen).outcome, SampleOutcome::kOnBorder);
    EXPECT_EQ(at(1, seen).outcome, seen == 1 ? SampleOutcome::kRight : SampleOutcome::kWrong);
    EXPECT_EQ(at(-1, seen).outcome, seen == 0 ? SampleOutcome::kRight : SampleOutcome::kWrong);
    EXPECT_EQ(at(0.005, seen).outcome,
              seen == 1 ? SampleOutcome::kRight : SampleOutcome::kNearBorder);
    EXPECT_EQ(at(-0.005, seen).outcome,
              seen == 0 ? SampleOutcome::kRight : SampleOutcome::kNearBorder);
  }
}

/// Points of a part: its corners, the middles of its edges, and mixtures of its corners.
std::vector<RationalPoint> points_of(const PreparedScene& scene, const Part& part, Random& random) {
  std::vector<RationalPoint> corners, points;
  for (const VertexId vertex : scene.loop(part)) {
    RationalPoint& corner = corners.emplace_back();
    for (int k = 0; k < 3; ++k) {
      corner[k] =
          scene.geometry.origin[k] + scene.geometry.step * scene.geometry.grid.at(vertex, k);
    }
  }
  for (int i = 0; i < 40; ++i) {
    RationalPoint sum;
    int whole = 0;
    for (const RationalPoint& corner : corners) {
      const int weight = i % 2 == 0 ? random.integer(0, 2) : random.integer(1, 1000);
      whole += weight;
      for (int k = 0; k < 3; ++k) sum[k] += weight * corner[k];
    }
    if (whole == 0) continue;
    for (int k = 0; k < 3; ++k) sum[k] /= whole;
    points.push_back(sum);
  }
  return points;
}

/// What is true all around a point, at points so near that nothing else comes in between.
Visibility seen_around(const VisibilityTest& test, const NearestPlaces& places,
                       const PreparedScene& scene, std::uint32_t part, const RationalPoint& point,
                       int directions) {
  const PlaneSteps steps(scene, part);
  bool lit = false, dark = false;
  for (int i = 0; i < directions; ++i) {
    const double angle = 6.283 * i / directions + 0.01;
    const RationalPoint near = steps.from(point, 1e-9 * std::cos(angle), 1e-9 * std::sin(angle));
    if (!places.holds(part, near)) continue;
    const Visibility seen = test.at(part, near).visibility;
    lit = lit || seen == Visibility::kLit;
    dark = dark || seen == Visibility::kShadow;
  }
  return lit && dark ? Visibility::kBoundary : dark ? Visibility::kShadow : Visibility::kLit;
}

TEST(PointSight, AgreesWithTheDefinitionOnLattices) {
  std::map<Visibility, int> touching;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const BuiltScene built = lattice_soup(seed, 14, 4);
    const NearestPlaces places(built.prepared);
    Random random(seed);
    for (const PreparedLight& light : built.prepared.lights) {
      const PointSight sight(built.prepared, light);
      const VisibilityTest test(built.prepared, light);
      for (std::uint32_t part = 0; part < built.prepared.parts.size(); ++part) {
        for (const RationalPoint& point :
             points_of(built.prepared, built.prepared.parts[part], random)) {
          const PointVisibility expected = test.at(part, point);
          const PointVisibility found = sight.at(std::span(&part, 1), point);
          if (expected.visibility != Visibility::kBoundary) {
            EXPECT_EQ(found.visibility, expected.visibility) << "seed " << seed << " part " << part;
            continue;
          }
          ++touching[found.visibility];
          // Narrow sectors lie between few directions.
          Visibility around = seen_around(test, places, built.prepared, part, point, 60);
          if (around != found.visibility) {
            around = seen_around(test, places, built.prepared, part, point, 6000);
          }
          EXPECT_EQ(found.visibility, around) << "seed " << seed << " part " << part << " at "
                                              << point[0] << ' ' << point[1] << ' ' << point[2];
        }
      }
    }
  }
  // All three kinds of touching are there.
  EXPECT_GT(touching[Visibility::kLit], 20);
  EXPECT_GT(touching[Visibility::kShadow], 20);
  EXPECT_GT(touching[Visibility::kBoundary], 100);
}

TEST(PointSight, AgreesWithTheDefinitionOnLargerScenes) {
  for (const char* name : {"city", "tetra", "touching-boxes"}) {
    auto scene = generate(name, name == std::string("city")
                                    ? std::map<std::string, std::int64_t>{{"n", 20}, {"light", 2}}
                                    : std::map<std::string, std::int64_t>{});
    ASSERT_TRUE(scene) << to_string(scene.error());
    const auto prepared = prepare(*scene);
    ASSERT_TRUE(prepared);
    Random random(7);
    const PointSight first(*prepared, prepared->lights.front());
    for (const PreparedLight& light : prepared->lights) {
      const PointSight sight(first, light);
      const VisibilityTest test(*prepared, light);
      for (std::uint32_t part = 0; part < prepared->parts.size(); ++part) {
        const auto points = points_of(*prepared, prepared->parts[part], random);
        for (std::size_t i = 0; i < 6; ++i) {
          const Visibility expected = test.at(part, points[i]).visibility;
          if (expected == Visibility::kBoundary) continue;
          EXPECT_EQ(sight.at(std::span(&part, 1), points[i]).visibility, expected)
              << name << ' ' << part;
        }
      }
    }
  }
}

TEST(AreaSight, SeesTheSameSharesAsWithAllCasters) {
  int partly = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const BuiltScene built = lattice_area_soup(seed, 12, 4);
    const PreparedLight& light = built.prepared.lights.front();
    const AreaSight sight(built.prepared, light);
    const AreaVisibility test(built.prepared, light);
    Random random(seed);
    for (std::uint32_t part = 0; part < built.prepared.parts.size(); ++part) {
      for (const RationalPoint& point :
           points_of(built.prepared, built.prepared.parts[part], random)) {
        for (const Side side : {Side::kFront, Side::kBack}) {
          const AreaPointVisibility expected = test.at(part, side, point);
          const AreaPointVisibility found = sight.at(part, side, point);
          EXPECT_EQ(found.visible, expected.visible) << "seed " << seed << " part " << part;
          EXPECT_EQ(found.jumps, expected.jumps) << "seed " << seed << " part " << part;
          EXPECT_EQ(found.state, expected.state);
          partly += expected.visible > 0 && expected.visible < 1;
        }
      }
    }
  }
  EXPECT_GT(partly, 100);
}

TEST(NearestPlaces, AreNearestByBruteForce) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const BuiltScene built = lattice_soup(seed, 20, 5);
    const NearestPlaces places(built.prepared);
    Random random(seed);
    for (int i = 0; i < 60; ++i) {
      const RationalPoint point = at(random.integer(-20, 60) / 8.0, random.integer(-20, 60) / 8.0,
                                     random.integer(-20, 60) / 8.0);
      mpq_class least = -1;
      for (std::uint32_t polygon = 0; polygon < built.scene.polygons.size(); ++polygon) {
        const auto place = places.on_polygon(polygon, point);
        if (!place) continue;
        if (least < 0 || place->squared_distance < least) least = place->squared_distance;
      }
      const auto near = places.all_near(point, 0.25);
      ASSERT_FALSE(near.empty());
      bool nearest = false;
      for (const PolygonPlace& place : near) {
        nearest = nearest || place.squared_distance == least;
        EXPECT_LE(place.distance, std::sqrt(least.get_d()) + 0.2500001);
        EXPECT_TRUE(places.holds(place.part, place.point));
      }
      EXPECT_TRUE(nearest);
    }
  }
}

}  // namespace
}  // namespace gnomon::oracle
