// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of a comparison on candidates that are wrong in one known way each.
#include "gnomon/oracle/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

/// A floor of 4 x 4, half of it (x < 2) in the shadow of "lid".
class Compare : public testing::Test {
 protected:
  Compare()
      : built_(SceneBuilder()
                   .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                   .polygon("lid", {{0, 0, 1}, {2, 0, 1}, {2, 4, 1}, {0, 4, 1}})
                   .sun("sun", {0, 0, 1})
                   .build()),
        answer_(built_.scene, built_.prepared) {}

  PolygonComparison compare(std::vector<ClaimedFragment> fragments,
                            std::optional<LightState> background = {},
                            const ComparisonOptions& options = {}) const {
    ClaimedPolygon polygon;
    polygon.id = "floor";
    polygon.fragments = std::move(fragments);
    ClaimedTerms terms;
    terms.background = background;
    return compare_entry(answer_, 0, answer_.entries(0)[0], &polygon, terms, options);
  }

  BuiltScene built_;
  ExactAnswer answer_;
  static constexpr LightState kIsLit = LightState::kLit;
  static constexpr LightState kIsShadow = LightState::kShadow;
};

TEST_F(Compare, RightInManyPieces) {
  const PolygonComparison found =
      compare({rectangle(kIsShadow, 0, 0, 2, 3), rectangle(kIsShadow, 0, 3, 2, 4),
               rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_TRUE(found.misclassified.zero);
  EXPECT_TRUE(found.overlapping.zero);
  EXPECT_TRUE(found.outside.zero);
  EXPECT_EQ(found.regions, 0u);
  EXPECT_EQ(found.t_vertices, 1u);
  EXPECT_EQ(found.lit.exact, mpq_class(1, 2));
  EXPECT_TRUE(found.lit.area.contains(8));
}

TEST_F(Compare, MissingSliver) {
  const double thin = 0x1p-40;
  const PolygonComparison found =
      compare({rectangle(kIsShadow, 0, 0, 2, 4), rectangle(kIsLit, 2 + thin, 0, 4, 4)});
  EXPECT_EQ(found.uncovered.exact, mpq_class(4 * thin) / 16);
  EXPECT_EQ(found.misclassified.exact, found.uncovered.exact);
  EXPECT_EQ(found.regions, 1u);
  EXPECT_LE(found.width.lower, thin);
  EXPECT_GE(found.width.upper, thin);
  EXPECT_LT(found.width.upper, 1e-11);
  EXPECT_EQ(found.worst[0].witness.kind, ErrorKind::kUncovered);
  EXPECT_EQ(found.lost, 0u);
}

TEST_F(Compare, SlantedSliverIsThinToo) {
  // Along the diagonal, bent at the middle: long, thin, and in no direction narrow as a whole.
  ClaimedFragment lower;
  lower.state = kIsShadow;
  const double thin = 0x1p-40;
  lower.loop = {at(0, 0, 0), at(2, 0, 0), at(2, 1.5, 0), at(1, 1, 0), at(0, 2, 0)};
  ClaimedFragment upper;
  upper.state = kIsShadow;
  upper.loop = {at(0, 2 + thin, 0), at(1, 1 + thin, 0), at(2, 1.5 + thin, 0), at(2, 4, 0),
                at(0, 4, 0)};
  const PolygonComparison found = compare({lower, upper, rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_EQ(found.regions, 1u);
  EXPECT_EQ(found.uncovered.exact, mpq_class(2 * thin) / 16);
  EXPECT_GT(found.width.upper, thin / 2);
  EXPECT_LT(found.width.upper, 1e-11);
  EXPECT_EQ(found.self_crossing, 0u);
}

TEST_F(Compare, WidthOfKnownShapes) {
  // A right triangle of sides 3, 4, 5 has the incircle of diameter 2; scaled by 1/2.
  ClaimedFragment triangle;
  triangle.state = kIsLit;
  triangle.loop = {at(0, 0, 0), at(1.5, 0, 0), at(0, 2, 0)};
  ClaimedFragment rest;
  rest.state = kIsShadow;
  rest.loop = {at(1.5, 0, 0), at(2, 0, 0), at(2, 4, 0), at(0, 4, 0), at(0, 2, 0)};
  const PolygonComparison found = compare({triangle, rest, rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_EQ(found.misclassified.exact, mpq_class(3, 32));
  EXPECT_LE(found.width.lower, 1.0);
  EXPECT_GE(found.width.upper, 1.0);
  EXPECT_GT(found.width.lower, 0.9);
  EXPECT_LT(found.width.upper, 1.1);
  EXPECT_EQ(found.invented, 1u);  // touches what is lit nowhere
}

TEST_F(Compare, Overlapping) {
  const PolygonComparison agreeing =
      compare({rectangle(kIsShadow, 0, 0, 2, 4), rectangle(kIsShadow, 0, 0, 1, 1),
               rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_TRUE(agreeing.misclassified.zero);
  EXPECT_EQ(agreeing.overlapping.exact, mpq_class(1, 16));
  EXPECT_EQ(agreeing.worst[0].witness.kind, ErrorKind::kOverlapping);
  const PolygonComparison disagreeing =
      compare({rectangle(kIsShadow, 0, 0, 3, 4), rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_EQ(disagreeing.misclassified.exact, mpq_class(1, 4));
  EXPECT_EQ(disagreeing.overlapping.exact, mpq_class(1, 4));
}

TEST_F(Compare, Outside) {
  const PolygonComparison found =
      compare({rectangle(kIsShadow, -1, 0, 2, 4), rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_TRUE(found.misclassified.zero);
  EXPECT_EQ(found.outside.exact, mpq_class(1, 4));
  EXPECT_EQ(found.worst[0].witness.kind, ErrorKind::kOutside);
  EXPECT_FALSE(found.worst[0].witness.truth.has_value());
}

TEST_F(Compare, OffPlaneIsProjected) {
  const PolygonComparison found =
      compare({rectangle(kIsShadow, 0, 0, 2, 4, 0.125), rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_TRUE(found.misclassified.zero);
  EXPECT_TRUE(found.off_plane.contains(0.125));
  EXPECT_LT(found.off_plane.upper - found.off_plane.lower, 1e-14);
}

TEST_F(Compare, SelfCrossing) {
  ClaimedFragment bow;
  bow.state = kIsShadow;
  bow.loop = {at(0, 0, 0), at(2, 4, 0), at(2, 0, 0), at(0, 4, 0)};
  const PolygonComparison found = compare({bow, rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_EQ(found.self_crossing, 1u);
  EXPECT_EQ(found.uncovered.exact, mpq_class(1, 4));
  EXPECT_EQ(found.regions, 2u);
}

TEST_F(Compare, BackgroundAndNothing) {
  EXPECT_TRUE(compare({rectangle(kIsShadow, 0, 0, 2, 4)}, kIsLit).misclassified.zero);
  const PolygonComparison half = compare({}, kIsShadow);
  EXPECT_EQ(half.misclassified.exact, mpq_class(1, 2));
  EXPECT_TRUE(half.uncovered.zero);
  EXPECT_EQ(half.lost, 1u);
  const PolygonComparison nothing = compare({});
  EXPECT_EQ(nothing.uncovered.exact, mpq_class(1));
  EXPECT_EQ(nothing.uncovered.fraction.upper, 1.0);
  EXPECT_EQ(nothing.lost, 2u);
}

TEST_F(Compare, OrientationAndRepeatedVerticesAreFree) {
  ClaimedFragment clockwise = rectangle(kIsShadow, 0, 0, 2, 4);
  std::reverse(clockwise.loop.begin(), clockwise.loop.end());
  clockwise.loop.insert(clockwise.loop.begin() + 1, clockwise.loop[1]);
  clockwise.loop.push_back(clockwise.loop.front());
  ClaimedFragment flat = rectangle(kIsLit, 0, 0, 0, 4);
  const PolygonComparison found = compare({clockwise, flat, rectangle(kIsLit, 2, 0, 4, 4)});
  EXPECT_TRUE(found.misclassified.zero);
  EXPECT_TRUE(found.overlapping.zero);
}

TEST_F(Compare, AWitnessIsInsideItsRegion) {
  for (int i = 0; i < 20; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    std::vector<ClaimedFragment> fragments;
    for (int k = 0; k < 6; ++k) {
      ClaimedFragment fragment;
      fragment.state = random.integer(0, 1) == 0 ? kIsLit : kIsShadow;
      for (int v = 0; v < 3; ++v) {
        fragment.loop.push_back(at(random.integer(0, 4), random.integer(0, 4), 0));
      }
      fragments.push_back(fragment);
    }
    const PolygonComparison found = compare(fragments);
    for (const ErrorRegion& region : found.worst) {
      const RationalPoint& p = region.witness.point;
      EXPECT_EQ(p[2], 0);
      if (!region.witness.truth) continue;
      EXPECT_EQ(*region.witness.truth, p[0] < 2 ? kIsShadow : kIsLit);
      EXPECT_GT(region.witness.width.upper, 0);
      EXPECT_LE(region.witness.width.lower, region.witness.width.upper);
      // Area of the disc is at most that of the region.
      EXPECT_LE(M_PI / 4 * region.witness.width.lower * region.witness.width.lower,
                region.area.area.upper);
    }
  }
}

/// With few regions kept, those that are seen to be narrower are not measured.
TEST_F(Compare, WidthsDoNotDependOnHowManyRegionsAreKept) {
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i) + 100);
    std::vector<ClaimedFragment> fragments;
    for (int k = 0; k < 8; ++k) {
      ClaimedFragment fragment;
      fragment.state = random.integer(0, 1) == 0 ? kIsLit : kIsShadow;
      for (int v = 0; v < 3; ++v) {
        fragment.loop.push_back(at(random.integer(0, 40) / 10.0, random.integer(0, 40) / 10.0, 0));
      }
      fragments.push_back(fragment);
    }
    ComparisonOptions options;
    options.most_regions = 1000;
    const PolygonComparison all = compare(fragments, {}, options);
    for (const std::size_t most : {0u, 1u, 3u}) {
      options.most_regions = most;
      const PolygonComparison few = compare(fragments, {}, options);
      EXPECT_EQ(few.regions, all.regions);
      EXPECT_EQ(few.misclassified.area.upper, all.misclassified.area.upper);
      EXPECT_LE(few.width.lower, all.width.upper);
      EXPECT_LE(all.width.lower, few.width.upper);
      EXPECT_LE(few.width.upper, 1.06 * all.width.upper);
      EXPECT_EQ(few.judged_width.upper, few.width.upper);
      ASSERT_EQ(few.worst.size(), std::min<std::size_t>(most, all.worst.size()));
      for (std::size_t r = 0; r < few.worst.size(); ++r) {
        EXPECT_LE(few.worst[r].witness.width.lower, all.worst[r].witness.width.upper);
        EXPECT_GE(few.worst[r].witness.width.upper, all.worst[r].witness.width.lower);
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::oracle
