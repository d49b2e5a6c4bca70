// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/region_width.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "oracle/geometry/box_tree.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

using Points = std::vector<std::pair<int, int>>;

/// Of the inside of a loop in the plane of a chart.
Enclosure width_of_loop(const Chart& chart, const std::vector<ChartPoint>& loop) {
  Overlay overlay;
  overlay.add_loop(loop, kReceiver);
  overlay.build();
  std::vector<std::uint32_t> boundary;
  overlay.for_each_halfedge(1, [&](std::uint32_t h) { boundary.push_back(h); });
  return measure_region(overlay, ChartMetric(chart), boundary, {}).width;
}

/// In the plane z = 0, whose chart is the plane itself.
Enclosure width_of_loop(const Points& points) {
  std::vector<ChartPoint> loop;
  for (const auto& [x, y] : points) loop.push_back({x, y, 1});
  return width_of_loop(Chart(ExactPlane{{0, 0, 1}, 0}), loop);
}

void expect_near(const Enclosure& width, double truth) {
  EXPECT_LE(width.lower, truth * (1 + 1e-9));
  EXPECT_GE(width.upper, truth * (1 - 1e-9));
  EXPECT_LE(width.upper, 1.06 * width.lower);
}

/// The diameter of the largest disc in a convex loop.
long double width_of(const PlanarLoop& loop) {
  long double low = 0, high = 2 * std::sqrt(area_of(loop));
  for (int step = 0; step < 60; ++step) {
    const long double middle = low + (high - low) / 2;
    (is_wider(loop, middle) ? low : high) = middle;
  }
  return high;
}

TEST(RegionWidth, LongStripsInAnyDirection) {
  for (const auto& [x, y, length] : {std::tuple{3, 4, 5}, {12, 5, 13}, {-15, 8, 17}, {1, 0, 1}}) {
    SCOPED_TRACE(testing::Message() << "along " << x << ", " << y);
    constexpr int kLong = 100'000;
    expect_near(
        width_of_loop({{0, 0}, {kLong * x, kLong * y}, {kLong * x - y, kLong * y + x}, {-y, x}}),
        length);
  }
}

TEST(RegionWidth, BentStrip) {
  // Two strips of width 10 that meet at a right angle: a disc fits into the corner a little better.
  const Enclosure width =
      width_of_loop({{0, 0}, {50'000, 0}, {50'000, 10}, {10, 10}, {10, 50'000}, {0, 50'000}});
  EXPECT_GE(width.upper, 20 * (2 - std::sqrt(2)) * (1 - 1e-9));
  EXPECT_LE(width.lower, 20 * (2 - std::sqrt(2)) * (1 + 1e-9));
  EXPECT_LE(width.upper, 1.06 * width.lower);
}

TEST(RegionWidth, Triangles) {
  expect_near(width_of_loop({{0, 0}, {400, 0}, {0, 300}}), 200);
  const double thin = 2 * 100'000.0 * 3 / (100'000 + 3 + std::hypot(100'000, 3));
  expect_near(width_of_loop({{0, 0}, {100'000, 0}, {100'000, 3}}), thin);
}

TEST(RegionWidth, RandomConvexLoops) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    PlanarLoop points;
    const int flat = i % 2 == 0 ? 1000 : 10;
    for (int k = 0; k < 3 + i % 7; ++k) {
      const int x = random.integer(-1000, 1000), y = random.integer(-flat, flat);
      points.push_back({static_cast<long double>(x + y), static_cast<long double>(x - 2 * y)});
    }
    const PlanarLoop hull = hull_of(points);
    if (hull.size() < 3) continue;
    Points loop;
    for (const PlanarPoint& p : hull) loop.emplace_back(std::lround(p.x), std::lround(p.y));
    expect_near(width_of_loop(loop), static_cast<double>(width_of(hull)));
    EXPECT_GE(strip_width_of(points), width_of(hull) * (1 - 1e-12L));
  }
}

/// The vectors (2, 1, -2), (2, -2, 1), (1, 2, 2) are orthogonal and 3 long.
TEST(RegionWidth, OnTiltedPlanes) {
  Random random(11);
  std::array<int, 3> axes{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      const auto turned = [&](const std::array<int, 3>& v) {
        Integers3 result;
        for (std::size_t k = 0; k < 3; ++k) {
          const int value = v[static_cast<std::size_t>(axes[k])];
          result[k] = (signs >> k) % 2 == 0 ? value : -value;
        }
        return result;
      };
      const Integers3 u = turned({2, 1, -2}), v = turned({2, -2, 1});
      const Chart chart(ExactPlane{turned({1, 2, 2}), 0});
      PlanarLoop points;
      for (int k = 0; k < 5; ++k) {
        points.push_back({static_cast<long double>(random.integer(-1000, 1000)),
                          static_cast<long double>(random.integer(-100, 100))});
      }
      const PlanarLoop hull = hull_of(points);
      std::vector<ChartPoint> loop;
      for (const PlanarPoint& p : hull) {
        Integers3 point;
        for (std::size_t k = 0; k < 3; ++k) {
          point[k] = u[k] * std::lround(p.x) + v[k] * std::lround(p.y);
        }
        loop.push_back(chart.at(point));
      }
      expect_near(width_of_loop(chart, loop), 3 * static_cast<double>(width_of(hull)));
    }
  } while (std::ranges::next_permutation(axes).found);
}

double distance_from(const Points& loop, double x, double y) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto& [ax, ay] = loop[i];
    const auto& [bx, by] = loop[(i + 1) % loop.size()];
    const double dx = bx - ax, dy = by - ay;
    const double t = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    least = std::min(least, std::hypot(x - ax - t * dx, y - ay - t * dy));
  }
  return least;
}

/// Stars of many corners, where most edges are far from the widest place: against all points of a
/// raster.
TEST(RegionWidth, StarsOfManyCorners) {
  constexpr int kReach = 1000, kStep = 10;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int corners = 12 + 8 * static_cast<int>(seed);
    Points loop;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double radius = random.integer(150, kReach);
      loop.emplace_back(std::lround(radius * std::cos(angle)),
                        std::lround(radius * std::sin(angle)));
    }
    double most = 0;
    for (int x = -kReach; x <= kReach; x += kStep) {
      for (int y = -kReach; y <= kReach; y += kStep) {
        bool inside = false;
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const auto& [ax, ay] = loop[i];
          const auto& [bx, by] = loop[(i + 1) % loop.size()];
          if ((ay > y) != (by > y) && x < ax + double(bx - ax) * (y - ay) / (by - ay)) {
            inside = !inside;
          }
        }
        if (inside) most = std::max(most, distance_from(loop, x, y));
      }
    }
    const Enclosure width = width_of_loop(loop);
    EXPECT_GE(width.upper, 2 * most);
    EXPECT_LE(width.lower, 2 * (most + kStep));  // no point is farther than that from the raster
    EXPECT_LE(width.upper, 1.06 * width.lower);
  }
}

PlanarBox random_box(Random& random) {
  const PlanarPoint a{static_cast<long double>(random.integer(0, 60)),
                      static_cast<long double>(random.integer(0, 60))};
  return box_of(a, PlanarPoint{a.x + random.integer(0, 6), a.y + random.integer(0, 6)});
}

TEST(BoxTree, FindsWhatLookingAtAllFinds) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    std::vector<PlanarBox> boxes;
    for (std::uint64_t i = 0; i < 5 * seed; ++i) boxes.push_back(random_box(random));
    const BoxTree tree(boxes);
    const PlanarBox asked = random_box(random);
    std::vector<std::uint32_t> found, expected;
    tree.meeting(asked, [&](std::uint32_t i) { found.push_back(i); });
    std::ranges::sort(found);
    const auto distance = [&](const PlanarBox& box) {
      const long double dx = std::max({0.0L, box.low.x - asked.low.x, asked.low.x - box.high.x});
      const long double dy = std::max({0.0L, box.low.y - asked.low.y, asked.low.y - box.high.y});
      return static_cast<double>(std::hypot(dx, dy));
    };
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (asked.meets(boxes[i])) expected.push_back(i);
      least = std::min(least, distance(boxes[i]));
    }
    EXPECT_EQ(found, expected);
    const auto value = [&](std::uint32_t i) { return distance(boxes[i]); };
    EXPECT_EQ(tree.least(std::numeric_limits<double>::infinity(), distance, value), least);
    EXPECT_EQ(tree.least(0, distance, value), 0);
  }
}

}  // namespace
}  // namespace gnomon::oracle
