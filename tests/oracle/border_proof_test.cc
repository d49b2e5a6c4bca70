// SPDX-License-Identifier: GPL-3.0-or-later
// Success by borders is held against the overlay: on scenes of every incidence, with claims that
// are right but for rounding and claims that are wrong by little and by much, the proof may never
// accept what the overlay rejects, and what it bounds must hold what the overlay measures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gnomon/oracle/verdict.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

/// As a program that writes doubles would.
void round_to_doubles(Claims& claims) {
  for (ClaimedLight& light : claims.lights) {
    for (ClaimedPolygon& polygon : light.polygons) {
      for (ClaimedFragment& fragment : polygon.fragments) {
        fragment.exact = false;
        for (RationalPoint& point : fragment.loop) {
          for (mpq_class& coordinate : point) coordinate = mpq_class(coordinate.get_d());
        }
      }
    }
  }
}

using Mistake = std::function<void(ClaimedPolygon&, std::size_t fragment, Random&)>;

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> all = {
      // Nothing: rounding alone.
      [](ClaimedPolygon&, std::size_t, Random&) {},
      // A vertex moved by 1e-16 to 1e-1.
      [](ClaimedPolygon& polygon, std::size_t f, Random& random) {
        RationalLoop& loop = polygon.fragments[f].loop;
        RationalPoint& point =
            loop[static_cast<std::size_t>(random.integer(0, static_cast<int>(loop.size()) - 1))];
        const double by = std::pow(10.0, random.integer(-16, -1));
        point[static_cast<std::size_t>(random.integer(0, 2))] +=
            mpq_class(random.integer(0, 1) ? by : -by);
      },
      // All of a fragment moved.
      [](ClaimedPolygon& polygon, std::size_t f, Random& random) {
        const double by = std::pow(10.0, random.integer(-16, -1));
        const auto axis = static_cast<std::size_t>(random.integer(0, 2));
        for (RationalPoint& point : polygon.fragments[f].loop) point[axis] += mpq_class(by);
      },
      [](ClaimedPolygon& polygon, std::size_t f, Random&) {
        LightState& state = polygon.fragments[f].state;
        state = state == LightState::kLit ? LightState::kShadow : LightState::kLit;
      },
      [](ClaimedPolygon& polygon, std::size_t f, Random&) {
        polygon.fragments.erase(polygon.fragments.begin() + static_cast<std::ptrdiff_t>(f));
      },
      [](ClaimedPolygon& polygon, std::size_t f, Random&) {
        polygon.fragments.push_back(polygon.fragments[f]);
      },
      // A hint that leads nowhere.
      [](ClaimedPolygon& polygon, std::size_t f, Random&) { polygon.fragments[f].caster = "no"; },
      // Another way around, and from another vertex.
      [](ClaimedPolygon& polygon, std::size_t f, Random&) {
        RationalLoop& loop = polygon.fragments[f].loop;
        loop = RationalLoop(loop.rbegin(), loop.rend());
      },
      // A loop that crosses itself, or has lost its last vertex.
      [](ClaimedPolygon& polygon, std::size_t f, Random&) {
        RationalLoop& loop = polygon.fragments[f].loop;
        if (loop.size() > 3) std::swap(loop[1], loop[2]);
      },
      [](ClaimedPolygon& polygon, std::size_t f, Random&) {
        RationalLoop& loop = polygon.fragments[f].loop;
        if (loop.size() > 3) loop.pop_back();
      },
      // A vertex in the middle of an edge, and all but there.
      [](ClaimedPolygon& polygon, std::size_t f, Random& random) {
        RationalLoop& loop = polygon.fragments[f].loop;
        RationalPoint middle;
        for (std::size_t k = 0; k < 3; ++k) middle[k] = (loop[0][k] + loop[1][k]) / 2;
        middle[static_cast<std::size_t>(random.integer(0, 2))] +=
            mpq_class(std::pow(10.0, random.integer(-18, -6)));
        loop.insert(loop.begin() + 1, middle);
      },
  };
  return all;
}

struct Counts {
  int sides = 0, proven = 0, failed = 0, within = 0, identical = 0;
};

/// Both ways agree, and bounds hold what is measured.
void compare_ways(const BuiltScene& built, const Claims& claims, CertifyOptions options,
                  Counts& counts) {
  options.threads = 1;
  const Report measured = certified(built, claims, options);
  options.borders = true;
  const Report proven = certified(built, claims, options);
  ASSERT_EQ(proven.verdict, measured.verdict) << proven.reason << " / " << measured.reason;
  EXPECT_EQ(proven.problems, measured.problems);
  (measured.verdict == Verdict::kFailed            ? counts.failed
   : measured.verdict == Verdict::kWithinTolerance ? counts.within
                                                   : counts.identical)++;
  ASSERT_EQ(proven.lights.size(), measured.lights.size());
  for (std::size_t l = 0; l < proven.lights.size(); ++l) {
    ASSERT_EQ(proven.lights[l].polygons.size(), measured.lights[l].polygons.size());
    for (std::size_t p = 0; p < proven.lights[l].polygons.size(); ++p) {
      const PolygonComparison& bounds = proven.lights[l].polygons[p];
      const PolygonComparison& truth = measured.lights[l].polygons[p];
      ++counts.sides;
      if (!bounds.by_borders) continue;
      ++counts.proven;
      for (const auto share : {&PolygonComparison::misclassified, &PolygonComparison::uncovered,
                               &PolygonComparison::overlapping, &PolygonComparison::outside}) {
        EXPECT_LE((truth.*share).fraction.lower, (bounds.*share).fraction.upper) << bounds.polygon;
        EXPECT_TRUE(!(bounds.*share).zero || (truth.*share).zero) << bounds.polygon;
      }
      EXPECT_LE(truth.width.lower, bounds.width.upper) << bounds.polygon;
      EXPECT_LE(truth.off_plane.lower, bounds.off_plane.upper) << bounds.polygon;
      for (const auto share : {&PolygonComparison::lit, &PolygonComparison::shadow}) {
        EXPECT_LE((truth.*share).fraction.lower, (bounds.*share).fraction.upper) << bounds.polygon;
        EXPECT_GE((truth.*share).fraction.upper, (bounds.*share).fraction.lower) << bounds.polygon;
      }
    }
  }
}

/// A tolerance and a width that are met or missed by little.
CertifyOptions some_limits(Random& random) {
  CertifyOptions options;
  if (random.integer(0, 2) == 0) return options;
  options.tolerance = std::pow(10.0, random.integer(-16, -2));
  if (random.integer(0, 1) == 0) options.width = std::pow(10.0, random.integer(-16, -2));
  return options;
}

Claims claims_with_mistake(const ExactAnswer& answer, Random& random) {
  Claims claims = exact_candidate(answer);
  round_to_doubles(claims);
  std::vector<ClaimedPolygon*> polygons;
  for (ClaimedLight& light : claims.lights) {
    for (ClaimedPolygon& polygon : light.polygons) {
      if (!polygon.fragments.empty()) polygons.push_back(&polygon);
    }
  }
  const auto pick = [&](std::size_t size) {
    return static_cast<std::size_t>(random.integer(0, static_cast<int>(size) - 1));
  };
  ClaimedPolygon& polygon = *polygons[pick(polygons.size())];
  mistakes()[pick(mistakes().size())](polygon, pick(polygon.fragments.size()), random);
  return claims;
}

TEST(BorderProof, AgreesWithTheOverlayOnLattices) {
  Counts counts;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const BuiltScene built = lattice_soup(seed, 4 + static_cast<int>(seed % 8), 3);
    const ExactAnswer answer(built.scene, built.prepared);
    Random random(seed + 1000);
    for (int i = 0; i < 6; ++i) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", claim " << i);
      compare_ways(built, claims_with_mistake(answer, random), some_limits(random), counts);
      if (HasFatalFailure()) return;
    }
  }
  // Not for want of proofs, or of mistakes.
  EXPECT_GT(counts.proven, counts.sides / 2);
  EXPECT_GT(counts.failed, 20);
  EXPECT_GT(counts.within, 20);
  EXPECT_GT(counts.identical, 0);
}

/// The lattice at places and in sizes where rounding is large.
TEST(BorderProof, AgreesWithTheOverlayFarFromTheOrigin) {
  Counts counts;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    BuiltScene built = lattice_soup(seed, 6, 3);
    Random random(seed + 2000);
    const double offset = std::ldexp(1.0, random.integer(0, 40));
    const double scale = std::ldexp(1.0 / 3, random.integer(-3, 3));
    const auto move = [&](Position& position) {
      for (Number& number : position) number = Number(number.nearest() * scale + offset);
    };
    for (Position& vertex : built.scene.vertices) move(vertex);
    for (Light& light : built.scene.lights) {
      if (light.is_point()) move(light.position);
    }
    Expected<PreparedScene> prepared = prepare(built.scene);
    if (!prepared) continue;
    built.prepared = std::move(*prepared);
    const ExactAnswer answer(built.scene, built.prepared);
    for (int i = 0; i < 6; ++i) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", claim " << i);
      compare_ways(built, claims_with_mistake(answer, random), some_limits(random), counts);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(counts.proven, counts.sides / 4);
}

TEST(BorderProof, IsNotUsedWhereSmallErrorCounts) {
  const BuiltScene built = lattice_soup(3, 8, 3);
  const ExactAnswer answer(built.scene, built.prepared);
  Claims claims = exact_candidate(answer);
  CertifyOptions options;
  options.borders = true;
  // Of exact loops only what has no strips is proven.
  EXPECT_EQ(certified(built, claims, options).verdict, Verdict::kIdentical);
  EXPECT_EQ(certified(built, claims, options).totals.by_borders, 0u);
  round_to_doubles(claims);
  options.strict = true;
  EXPECT_EQ(certified(built, claims, options).totals.by_borders, 0u);
  options.strict = false;
  options.clearance = 1;
  EXPECT_EQ(certified(built, claims, options).totals.by_borders, 0u);
  options.clearance = 0;
  options.leaks = 0;
  EXPECT_EQ(certified(built, claims, options).totals.by_borders, 0u);
}

}  // namespace
}  // namespace gnomon::oracle
