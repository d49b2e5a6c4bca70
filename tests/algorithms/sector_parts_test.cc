// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that the sectors algorithm is made of: sums that do not depend on their order and round
// outwards, splits whose planes are exactly where they say, enclosures of areas that hold the exact
// ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "algorithms/partition/fraction_sums.h"
#include "algorithms/partition/kd_tree.h"
#include "algorithms/partition/pair_area.h"
#include "algorithms/partition/piece_fractions.h"
#include "algorithms/sectors/sector_split.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

double random_double(Random& random, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(random.below(1ull << 53)), -53);
}

// --- FractionSums ---

std::vector<Ball> random_fractions(Random& random, std::size_t n) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = std::ldexp(1.0, -static_cast<int>(random.below(80)));
    const double middle = random_double(random, -0.01, 1) * scale / static_cast<double>(n);
    balls.emplace_back(middle, std::fabs(middle) * random_double(random, 0, 1e-9));
  }
  return balls;
}

TEST(FractionSums, EncloseTheExactSum) {
  Random random(1);
  for (const std::size_t n : {1u, 2u, 10u, 1000u}) {
    for (int round = 0; round < 50; ++round) {
      FractionSums sums(3);
      mpq_class low = 0, high = 0;
      for (const Ball& ball : random_fractions(random, n)) {
        low += mpq_class(ball.middle) - mpq_class(ball.radius);
        high += mpq_class(ball.middle) + mpq_class(ball.radius);
        sums.add_enclosure(1, ball);
      }
      const Interval bounds = sums.enclosure(1);
      EXPECT_LE(mpq_class(bounds.lower), low < 0 ? mpq_class(0) : low);
      EXPECT_GE(mpq_class(bounds.upper), high);
      // 2^-57 a summand, and the roundings of the result.
      const double width = mpq_class(high - low).get_d();
      EXPECT_LT(bounds.upper - bounds.lower,
                width * (1 + 1e-12) + static_cast<double>(n) * 0x1p-56 + 4 * Ball::kUnit);
      EXPECT_EQ(sums.enclosure(0).upper, 0x0p0);
    }
  }
}

TEST(FractionSums, DoNotDependOnTheOrderOrTheThreads) {
  Random random(2);
  std::vector<Ball> fractions = random_fractions(random, 4000);
  FractionSums first(1), second(1), third(1);
  for (const Ball& ball : fractions) first.add_enclosure(0, ball);
  random.shuffle(std::span(fractions));
  for (const Ball& ball : fractions) second.add_enclosure(0, ball);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < fractions.size(); i += 4) third.add_enclosure(0, fractions[i]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const FractionSums* other : {&second, &third}) {
    EXPECT_EQ(first.enclosure(0).lower, other->enclosure(0).lower);
    EXPECT_EQ(first.enclosure(0).upper, other->enclosure(0).upper);
  }
}

// What is left to 1 is known to the last digits of a double, however small it is.
TEST(FractionSums, KnowTheRestAsWell) {
  for (const int bits : {3, 20, 52, 60, 75}) {
    FractionSums sums(1);
    mpq_class sum = 0;
    for (int i = 0; i < 1000; ++i) {
      // All thousand add up to 1 - 2^-bits.
      const mpq_class share = (1 - mpq_class(std::ldexp(1.0, -bits))) / 1000;
      sums.add_enclosure(0, PairBall::of(share));
      sum += share;
    }
    const Interval rest = sums.rest(0), all = sums.enclosure(0);
    const mpq_class truth = 1 - sum;
    EXPECT_LE(mpq_class(rest.lower), truth);
    EXPECT_GE(mpq_class(rest.upper), truth);
    EXPECT_LT(rest.upper - rest.lower, 1e-15 * truth.get_d() + 2e-31) << bits;
    EXPECT_LE(mpq_class(all.lower), sum);
    EXPECT_GE(mpq_class(all.upper), sum);
  }
}

TEST(PairArea, QuotientsEncloseTheExactOne) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const auto pair = [&] {
      const double high = random_double(random, 0.1, 1);
      return PairBall(quick_two_sum(high, random_double(random, -1, 1) * 0x1p-60), 0x1p-90);
    };
    const auto exact = [](const PairBall& ball) {
      return mpq_class(mpq_class(ball.middle.high) + mpq_class(ball.middle.low));
    };
    const PairBall a = pair(), b = pair(), quotient = a / b;
    for (const int s : {-1, 1}) {
      for (const int t : {-1, 1}) {
        const mpq_class over = exact(a) + s * mpq_class(a.radius);
        const mpq_class truth = over / (exact(b) + t * mpq_class(b.radius));
        EXPECT_LE(abs(mpq_class(truth - exact(quotient))), mpq_class(quotient.radius));
      }
    }
    EXPECT_LT(quotient.radius, 0x1p-80);
  }
  EXPECT_FALSE((PairBall({1, 0}, 0) / PairBall({0, 0}, 0)).radius < 1);
}

/// Corners of a loop in pairs of doubles that are off by up to `error`.
struct PairLoop {
  struct Point {
    DoubleDouble x, y;
    double error = 0;
  };
  std::vector<Point> points;

  std::uint32_t size() const { return static_cast<std::uint32_t>(points.size()); }
  std::uint32_t corner(std::uint32_t i) const { return i; }
};

// True corners anywhere within the bounds of the given ones, whatever is far from the origin.
TEST(PairArea, LoopsEncloseTheExactArea) {
  Random random(8);
  const auto exact = [](const DoubleDouble& x) -> mpq_class {
    return mpq_class(x.high) + mpq_class(x.low);
  };
  for (int round = 0; round < 3000; ++round) {
    const double far = std::ldexp(1.0, static_cast<int>(random.below(30)));
    const double size = std::ldexp(1.0, -static_cast<int>(random.below(30)));
    const double error = round % 2 == 0 ? 0 : std::ldexp(size, -80);
    PairLoop loop;
    std::vector<std::array<mpq_class, 2>> truth;
    for (std::uint64_t n = 3 + random.below(6); n > 0; --n) {
      const auto coordinate = [&] {
        return two_sum(far + random_double(random, -size, size),
                       random_double(random, -size, size) * 0x1p-54);
      };
      loop.points.push_back({coordinate(), coordinate(), error});
      const auto off = [&] { return mpq_class(random_double(random, -1, 1) * error); };
      truth.push_back({exact(loop.points.back().x) + off(), exact(loop.points.back().y) + off()});
    }
    mpq_class sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const auto& next = truth[(i + 1) % truth.size()];
      sum += truth[i][0] * next[1] - truth[i][1] * next[0];
    }
    const PairBall area = twice_pair_area(loop, [&](std::uint32_t i) { return loop.points[i]; });
    ASSERT_LE(abs(mpq_class(sum - exact(area.middle))), mpq_class(area.radius)) << round;
    if (error == 0) {
      ASSERT_LT(area.radius, 0x1p-88 * far * size + 0x1p-88 * size * size) << round;
    }
  }
}

TEST(PairBall, HoldsRationalsOfAnySize) {
  mpz_class large = 1;
  for (int i = 0; i < 40; ++i) large *= 1000003;
  for (int power = 1; power <= 3; ++power, large *= large) {
    const mpq_class value(large - 7, 3 * large);
    const PairBall ball = PairBall::of(value);
    const mpq_class middle = mpq_class(ball.middle.high) + mpq_class(ball.middle.low);
    EXPECT_LE(abs(mpq_class(value - middle)), mpq_class(ball.radius));
    EXPECT_LT(ball.radius, 0x1p-99);
  }
}

TEST(FractionSums, StayWithinZeroAndOne) {
  FractionSums sums(2);
  sums.add_enclosure(0, Ball(1, 1e-12));
  EXPECT_EQ(sums.enclosure(0).upper, 1);
  EXPECT_GE(sums.enclosure(0).lower, 1 - 1.1e-12);
  sums.add_enclosure(1, Ball(0, 1e-12));
  EXPECT_EQ(sums.enclosure(1).lower, 0);
}

TEST(FractionSums, RoundedSumsDoNotDependOnTheOrder) {
  Random random(3);
  std::vector<double> fractions;
  for (int i = 0; i < 1000; ++i) fractions.push_back(random_double(random, 0, 1e-3));
  FractionSums first(1), second(1);
  for (const double x : fractions) first.add_rounded(0, true, x);
  random.shuffle(std::span(fractions));
  for (const double x : fractions) second.add_rounded(0, true, x);
  EXPECT_EQ(first.rounded(0, true), second.rounded(0, true));
  EXPECT_NEAR(first.rounded(0, true), 0.5, 0.05);
  EXPECT_EQ(first.rounded(0, false), 0);
}

TEST(FractionSums, WhatIsNoFractionStaysVisible) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 1e300}) {
    FractionSums sums(1);
    sums.add_rounded(0, true, 0.25);
    sums.add_rounded(0, true, bad);
    sums.add_rounded(0, true, 0.25);
    EXPECT_TRUE(std::isnan(sums.rounded(0, true))) << bad;
    EXPECT_EQ(sums.rounded(0, false), 0);
  }
  // Many that are too large each by little.
  FractionSums sums(1);
  for (int i = 0; i < 100; ++i) sums.add_rounded(0, false, 1.9);
  EXPECT_TRUE(std::isnan(sums.rounded(0, false)));
}

// --- SplitChooser, plane_of ---

SectorItem item_at(float u0, float u1, float v0, float v1) {
  SectorItem item;
  item.low = {u0, v0};
  item.high = {u1, v1};
  return item;
}

TEST(SplitChooser, SeparatesTwoClusters) {
  std::vector<SectorItem> items;
  for (int i = 0; i < 20; ++i) {
    const float v = i < 10 ? 0.0f : 0.75f;
    items.push_back(item_at(-1, 1, v, v + 0.2f));
  }
  SplitChooser chooser;
  const std::optional<ChartSplit> split = chooser.choose(items);
  ASSERT_TRUE(split);
  EXPECT_EQ(split->axis, 1);
  EXPECT_GT(split->value, 0.2);
  EXPECT_LT(split->value, 0.75);
  EXPECT_EQ(split->value, std::ldexp(static_cast<double>(split->steps), -split->bits));
}

TEST(SplitChooser, FindsNothingWhereNothingPays) {
  SplitChooser chooser;
  EXPECT_FALSE(chooser.choose({}));
  const float infinity = SectorItem::kInfinity;
  for (const SectorItem& item :
       {item_at(0, 1, 0, 1), item_at(0.5f, 0.5f, 0.5f, 0.5f),
        item_at(-infinity, infinity, -infinity, infinity), item_at(0, 0, 0, 0)}) {
    EXPECT_FALSE(chooser.choose(std::vector<SectorItem>(30, item)));
  }
}

TEST(SplitChooser, ValuesAreDyadicAndShort) {
  Random random(4);
  SplitChooser chooser;
  int chosen = 0;
  for (int round = 0; round < 500; ++round) {
    const double scale = std::ldexp(1.0, -static_cast<int>(random.below(30)));
    const double at = random_double(random, -1, 1);
    std::vector<SectorItem> items;
    for (int i = 0; i < 40; ++i) {
      const auto u = static_cast<float>(at + scale * random_double(random, -1, 1));
      const auto v = static_cast<float>(at + scale * random_double(random, -1, 1));
      const auto w = static_cast<float>(scale * random_double(random, 0, 0.1));
      items.push_back(item_at(u, u + w, v, v + w));
    }
    const std::optional<ChartSplit> split = chooser.choose(items);
    if (!split) continue;
    ++chosen;
    EXPECT_LE(split->bits, 60);
    EXPECT_EQ(std::ldexp(split->value, split->bits), static_cast<double>(split->steps));
    EXPECT_LT(std::fabs(split->value - at), 2 * scale + 0x1p-22);  // boxes are of floats
  }
  EXPECT_GT(chosen, 400);
}

TEST(PlaneOf, SeparatesExactlyAtTheValue) {
  Random random(5);
  for (int round = 0; round < 2000; ++round) {
    ChartSplit split;
    split.axis = static_cast<int>(random.below(2));
    split.bits = static_cast<int>(random.below(40));
    split.steps = random.between(-(std::int64_t{1} << split.bits), std::int64_t{1} << split.bits);
    split.value = std::ldexp(static_cast<double>(split.steps), -split.bits);
    const mpq_class value(split.value);
    const bool directional = random.chance(1, 2);
    const unsigned grid_bits = 1 + static_cast<unsigned>(random.below(60));
    LightChart chart;
    if (!directional) {
      chart.w = static_cast<int>(random.below(3));
      chart.u = (chart.w + 1) % 3;
      chart.v = (chart.w + 2) % 3;
    }
    chart.sign = random.chance(1, 2) ? 1 : -1;
    const PrefixPlane plane = plane_of(split, chart, directional, grid_bits);
    // A direction whose chart coordinate is the value, or beside it by a hair.
    for (const int side : {-1, 0, 1}) {
      std::array<mpq_class, 3> q;
      q[static_cast<std::size_t>(chart.w)] = chart.sign * (1 + random.between(0, 1000));
      q[static_cast<std::size_t>(chart.u)] = random.between(-1000, 1000);
      q[static_cast<std::size_t>(chart.v)] = random.between(-1000, 1000);
      const mpq_class unit = directional ? mpq_class(mpz_class(1) << grid_bits) : mpq_class(1);
      const mpq_class coordinate = value + side * mpq_class(1, mpz_class(1) << 200);
      q[static_cast<std::size_t>(split.axis == 0 ? chart.u : chart.v)] =
          coordinate * unit * q[static_cast<std::size_t>(chart.w)];
      mpq_class dot = 0;
      for (std::size_t k = 0; k < 3; ++k) dot += plane.n[k] * q[k];
      ASSERT_EQ(sgn(dot), side) << split.steps << " / 2^" << split.bits;
    }
  }
}

TEST(NLogN, IsItselfWithAndWithoutTheTable) {
  EXPECT_EQ(n_log_n(0), 0);
  EXPECT_EQ(n_log_n(1), 0);
  for (const std::size_t n : {2u, 3u, 4095u, 4096u, 4097u, 100000u}) {
    EXPECT_NEAR(n_log_n(n), static_cast<double>(n) * std::log2(static_cast<double>(n)), 1e-6);
  }
}

// --- twice_area ---

struct PointLoop {
  std::vector<PlanarPoint> points;
  std::uint32_t size() const { return static_cast<std::uint32_t>(points.size()); }
  const PlanarPoint& corner(std::uint32_t i) const { return points[i]; }
};

Ball area_of(const PointLoop& loop) {
  return twice_area(loop, [](const PlanarPoint& point) { return point; });
}

/// Twice the area of exact points anywhere within the errors must be enclosed.
TEST(TwiceArea, EnclosesAllThatThePointsMayBe) {
  Random random(6);
  for (int round = 0; round < 4000; ++round) {
    const int exponent = static_cast<int>(random.between(-300, 300));
    const double scale = std::ldexp(1.0, exponent);
    const double error = scale * std::ldexp(1.0, -static_cast<int>(random.between(1, 60)));
    const double far = random.chance(1, 3) ? 1e6 * scale : 0;
    PointLoop loop;
    std::vector<std::array<mpq_class, 2>> exact;
    const std::uint64_t n = random.between(3, 9);
    for (std::uint64_t i = 0; i < n; ++i) {
      const double x = far + scale * random_double(random, -1, 1);
      const double y = far + scale * random_double(random, -1, 1);
      const double own = random.chance(1, 4) ? 0 : error;
      loop.points.push_back({x, y, own});
      const auto moved = [&](double at) -> mpq_class {
        return mpq_class(at) + (random.chance(1, 2) ? 1 : -1) * mpq_class(own);
      };
      exact.push_back({moved(x), moved(y)});
    }
    mpq_class area = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto &a = exact[i], &b = exact[(i + 1) % n];
      area += a[0] * b[1] - a[1] * b[0];
    }
    const Ball ball = area_of(loop);
    ASSERT_TRUE(ball.is_finite());
    ASSERT_LE(abs(mpq_class(ball.middle) - area), mpq_class(ball.radius)) << round;
    // Not useless: of the order of the errors.
    const double size = 4 * static_cast<double>(n) * scale;
    ASSERT_LT(ball.radius, 8 * size * (error + 64 * Ball::kUnit * scale));
  }
}

TEST(TwiceArea, SaysNothingWhereNothingIsKnown) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double none = std::numeric_limits<double>::quiet_NaN();
  const PlanarPoint a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  for (const PlanarPoint& bad : {PlanarPoint{0.5, 0.5, infinity}, PlanarPoint{none, 0, infinity},
                                 PlanarPoint{0, none, 0}, PlanarPoint{none, none, 1e-9},
                                 PlanarPoint{infinity, 0, 0}, PlanarPoint{1e200, -1e200, 0}}) {
    for (const std::vector<PlanarPoint>& points :
         {std::vector{bad, a, b, c}, std::vector{a, bad, b, c}, std::vector{a, b, bad, c},
          std::vector{a, b, c, bad}, std::vector{bad, bad, bad, bad},
          std::vector{a, bad, bad, b}}) {
      const Ball area = area_of({points});
      if (std::fabs(bad.x) == 1e200) {
        EXPECT_TRUE(!(area.radius < 1e100) || area.middle == 0) << area.middle;
      } else {
        EXPECT_FALSE(area.radius < infinity) << area.middle << " +- " << area.radius;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon
