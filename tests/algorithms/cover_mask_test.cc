// SPDX-License-Identifier: GPL-3.0-or-later
// What masks of outlines and rectangles of shadows guarantee, held against exact points: a marked
// cell is all inside of one outline or outside of the receiver, a rectangle holds the shadow.
#include "algorithms/area_contour/cover_mask.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "algorithms/area_contour/shadow_boxes.h"

namespace gnomon::area_contour {
namespace {

using Exact3 = std::array<mpq_class, 3>;

/// a x + b y + c >= 0 in integers, and as a line of the chart.
struct IntegerLine {
  long a, b, c;

  OutlineLine line() const {
    const double length = std::hypot(static_cast<double>(a), static_cast<double>(b));
    OutlineLine result;
    result.a = static_cast<double>(a) / length;
    result.b = static_cast<double>(b) / length;
    result.c = static_cast<double>(c) / length;
    result.error = 0x1p-46 * 16;
    return result;
  }
};

class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  long whole(long low, long high) {
    return std::uniform_int_distribution<long>(low, high)(random_);
  }
  double real() { return std::uniform_real_distribution<double>(0, 1)(random_); }

 private:
  std::mt19937_64 random_;
};

/// A triangle or a quadrilateral, counter-clockwise, in a square of that side.
ReceiverChart receiver(Numbers& numbers, long side) {
  ReceiverChart chart;
  const auto at = [&](long x, long y) {
    chart.corners.push_back({static_cast<double>(x), static_cast<double>(y)});
  };
  at(0, 0);
  at(numbers.whole(side / 2, side), 0);
  at(side, numbers.whole(side / 2, side));
  if (numbers.whole(0, 1) == 1) at(0, numbers.whole(side / 2, side));
  chart.reach = 1.5 * static_cast<double>(side);
  return chart;
}

/// An outline of lines near a circle, so that it has an inside.
std::vector<IntegerLine> outline(Numbers& numbers, long side) {
  std::vector<IntegerLine> lines;
  const long x = numbers.whole(0, side), y = numbers.whole(0, side), r = numbers.whole(1, side);
  const long directions[][2] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                {2, 1}, {-1, 2}, {-3, -1}, {1, -2}};
  for (const auto& direction : directions) {
    if (numbers.whole(0, 3) == 0) continue;
    const long a = direction[0], b = direction[1];
    lines.push_back({a, b, -a * x - b * y + r});
  }
  if (lines.size() < 3) lines = {{1, 0, r - x}, {-1, 1, r + x - y}, {0, -1, r + y}};
  return lines;
}

bool holds(const std::vector<IntegerLine>& lines, const mpq_class& x, const mpq_class& y) {
  return std::ranges::all_of(
      lines, [&](const IntegerLine& line) { return line.a * x + line.b * y + line.c > 0; });
}

bool is_on(const ReceiverChart& chart, const mpq_class& x, const mpq_class& y) {
  for (std::uint32_t i = 0; i < chart.size(); ++i) {
    const auto &p = chart.corners[i], &q = chart.corners[chart.next(i)];
    if ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) < 0) return false;
  }
  return true;
}

TEST(CoverMask, WhatItHoldsIsInsideOfOutlines) {
  constexpr long kSide = 16;
  constexpr int kAsked = 48;
  int held = 0, asked = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    Numbers numbers(seed);
    const ReceiverChart chart = receiver(numbers, kSide);
    CoverMask mask;
    mask.begin(chart);
    std::vector<std::vector<IntegerLine>> outlines;
    for (long i = numbers.whole(1, 4); i-- > 0;) {
      outlines.push_back(outline(numbers, kSide));
      std::vector<OutlineLine> lines;
      for (const IntegerLine& line : outlines.back()) lines.push_back(line.line());
      mask.add(lines, mask.box());
    }
    for (int i = 0; i < kAsked; ++i) {
      // Rectangles on the lattice, whose borders are edges of outlines, and between.
      const double step = numbers.whole(0, 1) == 0 ? 1 : 0.37;
      const double x = step * static_cast<double>(numbers.whole(0, kSide)),
                   y = step * static_cast<double>(numbers.whole(0, kSide));
      const double width = numbers.real() * 4, height = numbers.real() * 4;
      const double m = mask.margin();
      ++asked;
      if (!mask.holds({{x - m, y - m}, {x + width + m, y + height + m}})) continue;
      ++held;
      for (int k = 0; k < 16; ++k) {
        const mpq_class px = mpq_class(x) + mpq_class(k % 4, 3) * width,
                        py = mpq_class(y) + mpq_class(k / 4, 3) * height;
        const bool covered =
            std::ranges::any_of(outlines, [&](const auto& lines) { return holds(lines, px, py); });
        EXPECT_TRUE(covered || !is_on(chart, px, py)) << seed << ": " << px << ' ' << py;
      }
    }
    if (!mask.is_full()) continue;
    for (const auto& corner : chart.corners) {
      EXPECT_TRUE(std::ranges::any_of(outlines, [&](const auto& lines) {
        return holds(lines, corner[0], corner[1]);
      })) << seed;
    }
  }
  EXPECT_GT(held, asked / 20);
  EXPECT_LT(held, asked);
}

TEST(CoverMask, OneOutlineAroundTheReceiverFillsIt) {
  Numbers numbers(1);
  const ReceiverChart chart = receiver(numbers, 16);
  CoverMask mask;
  mask.begin(chart);
  EXPECT_FALSE(mask.is_full());
  // The receiver's own border is not enough: nothing is known to be inside of it with a margin.
  std::vector<OutlineLine> lines;
  for (const IntegerLine& line : {IntegerLine{1, 0, 0}, {0, 1, 0}, {-1, 0, 16}, {0, -1, 16}}) {
    lines.push_back(line.line());
  }
  mask.add(lines, mask.box());
  EXPECT_FALSE(mask.is_full());
  for (OutlineLine& line : lines) line.c += 1;
  mask.add(lines, mask.box());
  EXPECT_TRUE(mask.is_full());
}

/// Where the ray from a through o meets z = 0, by exact rationals.
std::array<mpq_class, 2> shadow(const Exact3& a, const Exact3& o) {
  const mpq_class t = o[2] / (a[2] - o[2]);
  return {o[0] + t * (o[0] - a[0]), o[1] + t * (o[1] - a[1])};
}

Exact3 mixed(const std::vector<Point3>& corners, Numbers& numbers) {
  Exact3 point{};
  long all = 0;
  std::vector<long> weights;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    weights.push_back(numbers.whole(0, 3) == 0 ? 0 : numbers.whole(0, 100));
    all += weights.back();
  }
  if (all == 0) all = weights[0] = 1;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      point[k] += mpq_class(weights[i], all) * mpq_class(corners[i][k]);
  }
  for (mpq_class& value : point) value.canonicalize();
  return point;
}

TEST(ShadowBoxes, HoldTheShadowOfEveryPointOfACaster) {
  // A receiver in z = 0 whose first corner is not the origin, casters above it, touching it and
  // through it, lights of three to five corners above them.
  int known = 0, umbras = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    Numbers numbers(seed);
    const std::vector<Point3> loop = {
        {0.25, 0.25, 0}, {0.75, 0.25, 0}, {0.75, 0.75, 0}, {0.25, 0.75, 0}};
    ReceiverChart chart;
    ASSERT_TRUE(chart.make({0, 0, 0.5}, loop, 0x1p-52, 0x1p-47));
    std::vector<Point3> light, caster;
    const auto around = [&](double low, double high) {
      return Point3{numbers.real(), numbers.real(), low + (high - low) * numbers.real()};
    };
    for (long i = numbers.whole(3, 5); i-- > 0;) light.push_back(around(0.8, 1));
    const double lowest[] = {0.1, 0, -0.1}, highest[] = {0.7, 0.3, 0.79};
    const auto kind = static_cast<std::size_t>(numbers.whole(0, 2));
    for (long i = numbers.whole(3, 6); i-- > 0;) {
      caster.push_back(around(lowest[kind], highest[kind]));
    }
    if (kind == 1) caster[0][2] = 0;
    ShadowProjection projection;
    projection.begin(chart, {0, 0, 0.5}, 0, 0x1p-47, light, 0);
    const ShadowBoxes boxes = projection.boxes(caster);
    EXPECT_EQ(boxes.place, ShadowBoxes::Place::kInFront);
    known += std::isfinite(boxes.penumbra.low[0]) ? 1 : 0;
    umbras += boxes.umbra.is_empty() ? 0 : 1;
    for (int k = 0; k < 40; ++k) {
      const Exact3 o = mixed(caster, numbers);
      if (o[2] < 0) continue;
      const auto in = [&](const ChartBox& box, const std::array<mpq_class, 2>& p) {
        // The chart's two coordinates may be x and y or y and x.
        const std::array<mpq_class, 3> place{p[0] - mpq_class(0.25), p[1] - mpq_class(0.25), 0};
        const mpq_class &u = place[chart.u()], &v = place[chart.v()];
        return u >= box.low[0] && u <= box.high[0] && v >= box.low[1] && v <= box.high[1];
      };
      if (!std::isfinite(boxes.penumbra.low[0])) continue;
      EXPECT_TRUE(in(boxes.penumbra, shadow(mixed(light, numbers), o))) << seed;
      // A point in the umbra is in the shadow from each corner: its rectangle is no smaller than
      // what all corners' shadows have in common, tried at shadows of the caster's points.
      const std::array<mpq_class, 2> p =
          shadow({mpq_class(light[0][0]), mpq_class(light[0][1]), mpq_class(light[0][2])}, o);
      bool in_all = true;
      for (const Point3& corner : light) {
        ShadowProjection one;
        one.begin(chart, {0, 0, 0.5}, 0, 0x1p-47, {&corner, 1}, 0);
        in_all = in_all && in(one.boxes(caster).penumbra, p);
      }
      EXPECT_EQ(in_all && !in(boxes.umbra, p), false) << seed;
    }
  }
  EXPECT_GT(known, 300);
  EXPECT_GT(umbras, 20);
}

TEST(ShadowBoxes, CastersBehindTheReceiverAndAtTheLight) {
  ReceiverChart chart;
  const std::vector<Point3> loop = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  ASSERT_TRUE(chart.make({0, 0, 0.5}, loop, 0x1p-52, 0x1p-47));
  const std::vector<Point3> light = {{0.4, 0.4, 1}, {0.6, 0.4, 1}, {0.5, 0.6, 1}};
  ShadowProjection projection;
  projection.begin(chart, {0, 0, 0.5}, 0, 0x1p-47, light, 0);
  const std::vector<Point3> behind = {{0, 0, -0.25}, {1, 0, -0.25}, {0, 1, -0.5}};
  EXPECT_EQ(projection.boxes(behind).place, ShadowBoxes::Place::kBehind);
  const std::vector<Point3> in_plane = {{0, 0, 0}, {1, 0, 0}, {0, 1, -0.5}};
  EXPECT_EQ(projection.boxes(in_plane).place, ShadowBoxes::Place::kUnknown);
  const std::vector<Point3> at_light = {{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 1}};
  EXPECT_FALSE(std::isfinite(projection.boxes(at_light).penumbra.low[0]));
}

}  // namespace
}  // namespace gnomon::area_contour
