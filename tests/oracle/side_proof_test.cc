// SPDX-License-Identifier: GPL-3.0-or-later
// Exact claims proved in integers: the predicates against rational numbers, edges that cancel, and
// whether the proof ever says of a wrong claim that it holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "gnomon/oracle/witness_check.h"
#include "oracle/geometry/scene_point.h"
#include "oracle/geometry/space_loop.h"
#include "oracle/judge/edge_chains.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

/// Numerators and denominators of up to so many bits, zero now and then.
mpq_class any_rational(Random& random, int bits) {
  const auto part = [&] {
    mpz_class own;
    for (int size = random.integer(1, bits); size > 0; size -= 60) {
      own = (own << std::min(size, 60)) + (random.next() >> (64 - std::min(size, 60)));
    }
    return own;
  };
  mpq_class value(random.integer(0, 9) == 0 ? mpz_class(0) : part(), part() + 1);
  value.canonicalize();
  return random.integer(0, 1) == 0 ? value : mpq_class(-value);
}

/// Bits on both sides of every bound of the short ways.
constexpr int kBits[] = {4, 18, 30, 38, 41, 58, 62, 64, 150};

TEST(ScenePoint, SidesAreThoseOfRationalNumbers) {
  Random random(1);
  for (const int bits : kBits) {
    for (int i = 0; i < 300; ++i) {
      const RationalPoint point{any_rational(random, bits), any_rational(random, bits),
                                any_rational(random, bits)};
      ExactPlane plane;
      for (mpz_class& component : plane.normal) component = any_rational(random, bits).get_num();
      plane.offset = any_rational(random, bits).get_num();
      Geometry geometry;
      geometry.step = abs(any_rational(random, 20)) + 1;
      geometry.origin = {any_rational(random, 20), 0, any_rational(random, 20)};
      mpq_class value = -plane.offset * geometry.step;
      for (int k = 0; k < 3; ++k) value += plane.normal[k] * (point[k] - geometry.origin[k]);
      EXPECT_EQ(sign_of_product(scene_plane(geometry, plane), scene_point(point)), sgn(value));
      // A point of the plane, by its last coordinate.
      if (plane.normal[2] == 0) continue;
      RationalPoint on = point;
      on[2] -= value / plane.normal[2];
      EXPECT_EQ(sign_of_product(scene_plane(geometry, plane), scene_point(on)), 0);
    }
  }
}

TEST(ScenePoint, TheLargestSmallNumbersDoNotOverflow) {
  const std::int64_t small = (std::int64_t{1} << Integers4::kSmallBits) - 1;
  const std::int64_t tiny = (std::int64_t{1} << Integers4::kTinyBits) - 1;
  const auto all = [](std::int64_t value) {
    return Integers4(std::array<std::int64_t, 4>{value, value, value, value});
  };
  ASSERT_TRUE(all(small).is_small() && !all(small + 1).is_small());
  ASSERT_TRUE(all(tiny).is_tiny() && !all(tiny + 1).is_tiny());
  EXPECT_EQ(sign_of_product(all(small), all(small)), 1);
  EXPECT_EQ(sign_of_product(all(small), all(-small)), -1);
  // Each of the determinant's six products at its largest and of one sign.
  const PlaneTurn turn(Integers3{0, 0, 1});
  const Integers4 a(std::array<std::int64_t, 4>{-tiny, tiny, 0, tiny}),
      b(std::array<std::int64_t, 4>{-tiny, -tiny, 0, tiny}),
      c(std::array<std::int64_t, 4>{tiny, -tiny, 0, tiny});
  EXPECT_EQ(turn(a, b, c), 1);
  EXPECT_EQ(turn(c, b, a), -1);
}

TEST(ScenePoint, TurnsAndPlanesAreThoseOfRationalNumbers) {
  Random random(2);
  for (const int bits : kBits) {
    for (int i = 0; i < 200; ++i) {
      // Points of the plane z = 2 x + y / 3; every third triple is on one line.
      std::array<RationalPoint, 4> p;
      for (RationalPoint& own : p) {
        own = {any_rational(random, bits), any_rational(random, bits), 0};
      }
      if (i % 3 == 0) {
        const mpq_class t = any_rational(random, 8);
        for (int k = 0; k < 2; ++k) p[2][k] = p[0][k] + t * (p[1][k] - p[0][k]);
      }
      for (RationalPoint& own : p) own[2] = 2 * own[0] + own[1] / 3;
      const Integers3 normal{-6, -1, 3};
      const PlaneTurn turn(normal);
      const space::PlaneView view({-6, -1, 3});
      std::vector<Integers4> at;
      for (const RationalPoint& own : p) at.push_back(scene_point(own));
      EXPECT_EQ(turn(at[0], at[1], at[2]), view.turn(p[0], p[1], p[2]));
      const Integers4 light(std::array<mpz_class, 4>{1, 2, 9, i % 2});
      const Integers4 plane = plane_through(at[0], at[1], light);
      EXPECT_EQ(sign_of_product(plane, at[0]), 0);
      EXPECT_EQ(sign_of_product(plane, at[1]), 0);
      EXPECT_EQ(sign_of_product(plane, light), 0);
      EXPECT_EQ(sign_of_product(plane, at[2]) == 0, turn(at[0], at[1], at[2]) == 0);
      const space::Loop loop{p[0], p[1], p[2]}, other{p[1], p[3], p[2]};
      const mpq_class a = turn.doubled_area({&at[0], &at[1], &at[2]});
      const mpq_class b = turn.doubled_area({&at[1], &at[3], &at[2]});
      EXPECT_EQ(a * view.area(other), b * view.area(loop));
    }
  }
}

/// Loops of points of the plane, in whole numbers.
class Chains : public testing::Test {
 protected:
  using Corners = std::vector<std::pair<int, int>>;
  std::vector<std::uint32_t> loop(const Corners& corners) {
    std::vector<std::uint32_t> result;
    for (const auto& corner : corners) {
      const auto found = std::ranges::find(points_, corner);
      result.push_back(static_cast<std::uint32_t>(found - points_.begin()));
      if (found == points_.end()) points_.push_back(corner);
    }
    return result;
  }
  bool tile(const std::vector<Corners>& loops, const Corners& whole) {
    EdgeChains chains;
    for (const Corners& own : loops) chains.add(loop(own), 1);
    chains.add(loop(whole), -1);
    if (chains.cancel()) return true;
    std::vector<PlanarPoint> places;
    for (const auto& [x, y] : points_) {
      places.push_back({static_cast<long double>(x), static_cast<long double>(y)});
    }
    VertexFrame frame;
    frame.place = [&](std::uint32_t v) -> const PlanarPoint& { return places[v]; };
    // As bad as can be: nothing is told by the frame.
    frame.error = error_;
    frame.turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const auto [ax, ay] = points_[a];
      const auto [bx, by] = points_[b];
      const auto [cx, cy] = points_[c];
      const int turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      return turn > 0 ? 1 : turn < 0 ? -1 : 0;
    };
    frame.before = [&](std::uint32_t a, std::uint32_t b) { return points_[a] < points_[b]; };
    return chains.cancel_led_through(frame);
  }

  std::vector<std::pair<int, int>> points_;
  long double error_ = 0x1p-58L;
};

TEST_F(Chains, CancelIfLoopsTileAndOnlyThen) {
  const Corners whole{{0, 0}, {12, 0}, {12, 12}, {0, 12}};
  const Corners left{{0, 0}, {6, 0}, {6, 12}, {0, 12}};
  const Corners low{{6, 0}, {12, 0}, {12, 5}, {6, 5}}, high{{6, 5}, {12, 5}, {12, 12}, {6, 12}};
  for (const long double error : {0.0L, 0x1p-58L, 100.0L}) {
    error_ = error;
    EXPECT_TRUE(tile({whole}, whole));
    EXPECT_TRUE(tile({left, low, high}, whole));
    EXPECT_FALSE(tile({left, low}, whole));
    EXPECT_FALSE(tile({left, low, high, high}, whole));
    EXPECT_FALSE(tile({left, low, Corners{{6, 4}, {12, 4}, {12, 12}, {6, 12}}}, whole));
    EXPECT_FALSE(tile({left, low, Corners{{6, 6}, {12, 6}, {12, 12}, {6, 12}}}, whole));
    EXPECT_FALSE(tile({left, low, Corners{{6, 5}, {13, 5}, {13, 12}, {6, 12}}}, whole));
    EXPECT_FALSE(tile({Corners(whole.rbegin(), whole.rend())}, whole));
    // Three loops meet on one line at different points.
    EXPECT_TRUE(tile(
        {Corners{{0, 0}, {12, 0}, {12, 4}, {0, 4}}, Corners{{0, 4}, {5, 4}, {5, 12}, {0, 12}},
         Corners{{5, 4}, {9, 4}, {9, 12}, {5, 12}}, Corners{{9, 4}, {12, 4}, {12, 12}, {9, 12}}},
        whole));
  }
}

/// A change that is in general wrong, and now and then is not.
void spoil(Claims& claims, Random& random) {
  ClaimedLight& light = claims.lights[random.next() % claims.lights.size()];
  ClaimedPolygon& polygon = light.polygons[random.next() % light.polygons.size()];
  if (polygon.fragments.empty()) return;
  ClaimedFragment& fragment = polygon.fragments[random.next() % polygon.fragments.size()];
  RationalPoint& vertex = fragment.loop[random.next() % fragment.loop.size()];
  mpq_class hair(random.integer(0, 1) == 0 ? 1 : -1);
  mpq_div_2exp(hair.get_mpq_t(), hair.get_mpq_t(), static_cast<unsigned>(random.integer(0, 90)));
  switch (random.integer(0, 8)) {
    case 0:
      fragment.state = fragment.state == LightState::kLit ? LightState::kShadow : LightState::kLit;
      break;
    case 1:
      fragment.caster = light.polygons[random.next() % light.polygons.size()].id;
      fragment.state = LightState::kShadow;
      break;
    case 2:
      vertex[random.next() % 3] += hair;
      break;
    case 3: {
      // Within the plane, along an edge.
      const RationalPoint& other = fragment.loop[random.next() % fragment.loop.size()];
      for (int k = 0; k < 3; ++k) vertex[k] += hair * (other[k] - vertex[k]);
      break;
    }
    case 4:
      std::swap(fragment.loop[0], fragment.loop[random.next() % fragment.loop.size()]);
      break;
    case 5:
      std::ranges::reverse(fragment.loop);
      break;
    case 6:
      polygon.fragments.push_back(fragment);
      break;
    case 7:
      polygon.fragments.erase(polygon.fragments.begin() + (&fragment - polygon.fragments.data()));
      break;
    default: {
      std::optional<mpq_class>& share =
          random.integer(0, 1) == 0 ? polygon.lit_fraction : polygon.shadow_fraction;
      share = mpq_class(random.integer(0, 4), 4);
      share->canonicalize();
      break;
    }
  }
}

TEST(SideProof, SaysWhatRationalNumbersSay) {
  int wrong = 0, right = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const BuiltScene built = lattice_soup(seed, 12, 4);
    const ExactAnswer answer(built.scene, built.prepared);
    const Claims good = exact_candidate(answer);
    Random random(seed);
    for (int i = 0; i < 25; ++i) {
      Claims claims = good;
      if (i > 0) spoil(claims, random);
      WitnessOptions options;
      const WitnessReport proved = check_witnesses(built.scene, built.prepared, claims, options);
      options.by_integers = false;
      const WitnessReport checked = check_witnesses(built.scene, built.prepared, claims, options);
      ASSERT_EQ(proved.violations, checked.violations)
          << seed << " " << i << ": "
          << (checked.findings.empty() ? proved : checked).findings[0].polygon << " "
          << (checked.findings.empty() ? proved : checked).findings[0].text;
      ASSERT_EQ(proved.findings.size(), checked.findings.size());
      for (std::size_t f = 0; f < checked.findings.size(); ++f) {
        EXPECT_EQ(proved.findings[f].polygon, checked.findings[f].polygon);
        EXPECT_EQ(proved.findings[f].text, checked.findings[f].text);
      }
      EXPECT_EQ(proved.polygons, checked.polygons);
      EXPECT_EQ(proved.fragments, checked.fragments);
      EXPECT_EQ(proved.exact_fragments, checked.exact_fragments);
      EXPECT_EQ(proved.witnesses, checked.witnesses);
      ++(checked.violations > 0 ? wrong : right);
    }
  }
  EXPECT_GT(wrong, 160);
  EXPECT_GT(right, 20);
}

}  // namespace
}  // namespace gnomon::oracle
