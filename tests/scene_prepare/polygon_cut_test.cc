// SPDX-License-Identifier: GPL-3.0-or-later
// Cutting one polygon: by ears and by the sweep, the same region; large ones, in time; interrupted.
#include "scene/prepare/polygon_cut.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <map>

#include "builder.h"
#include "gnomon/scene/prepare_control.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using scene_detail::CutInput;

/// Rings over integer points, whose numbers in order of appearance are their keys.
class Rings {
 public:
  using Points = std::vector<std::pair<int, int>>;

  Rings& ring(const Points& points) {
    input_.rings.emplace_back();
    for (const auto& point : points) {
      const auto [at, is_new] = index_.emplace(point, static_cast<std::uint32_t>(input_.x.size()));
      if (is_new) {
        input_.x.push_back(point.first);
        input_.y.push_back(point.second);
        input_.key.push_back(at->second);
      }
      input_.rings.back().push_back(at->second);
    }
    return *this;
  }
  CutInput<std::int64_t> input(bool by_sweep) const {
    CutInput<std::int64_t> input = input_;
    input.most_for_ears = by_sweep ? 0 : 100'000;
    return input;
  }
  /// In how many parts the point (x + 371/1001, y + 613/1001) is. No line through two integer
  /// points at most 24 apart holds it.
  static int cover(const CutInput<std::int64_t>& input,
                   const std::vector<std::vector<std::uint32_t>>& parts, int x, int y) {
    int count = 0;
    for (const auto& part : parts) {
      bool inside = true;
      for (std::size_t i = 0; i < part.size(); ++i) {
        inside = inside && turn(input, part[i], part[(i + 1) % part.size()], x, y) > 0;
      }
      count += inside ? 1 : 0;
    }
    return count;
  }
  /// Twice the area.
  static std::int64_t area(const CutInput<std::int64_t>& input,
                           const std::vector<std::uint32_t>& ring) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
      sum += input.x[a] * input.y[b] - input.y[a] * input.x[b];
    }
    return sum;
  }

 private:
  static constexpr std::int64_t kUnit = 1001;

  static std::int64_t turn(const CutInput<std::int64_t>& input, std::uint32_t a, std::uint32_t b,
                           int x, int y) {
    return (input.x[b] - input.x[a]) * (kUnit * (y - input.y[a]) + 613) -
           (input.y[b] - input.y[a]) * (kUnit * (x - input.x[a]) + 371);
  }

  CutInput<std::int64_t> input_;
  std::map<std::pair<int, int>, std::uint32_t> index_;
};

/// Both rules make convex parts of the same area, which cover the same points once.
void expect_same_region(const Rings& rings, int size) {
  const CutInput<std::int64_t> input = rings.input(false);
  const auto ears = cut_into_convex_parts(input), swept = cut_into_convex_parts(rings.input(true));
  ASSERT_EQ(ears.has_value(), swept.has_value());
  if (!ears) {
    EXPECT_EQ(ears.error().what, swept.error().what);
    return;
  }
  std::int64_t areas[2] = {0, 0};
  for (const auto& part : *ears) areas[0] += Rings::area(input, part);
  for (const auto& part : *swept) {
    areas[1] += Rings::area(input, part);
    EXPECT_GT(Rings::area(input, part), 0);
  }
  EXPECT_EQ(areas[0], areas[1]);
  for (int x = -1; x <= size; ++x) {
    for (int y = -1; y <= size; ++y) {
      ASSERT_EQ(Rings::cover(input, *ears, x, y) > 0, Rings::cover(input, *swept, x, y) > 0)
          << x << " " << y;
      ASSERT_LE(Rings::cover(input, *swept, x, y), 1);
    }
  }
}

TEST(Sweep, HolesThatTouchInEveryWay) {
  constexpr int kSize = 7;
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    Rings rings;
    rings.ring({{0, 0}, {kSize, 0}, {kSize, kSize}, {0, kSize}});
    for (int x = 0; x < kSize; ++x) {
      for (int y = 0; y < kSize; ++y) {
        if (!random.chance(1, 1 + static_cast<unsigned>(round % 4))) continue;
        if (random.chance(1, 2)) {
          rings.ring({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
        } else if (random.chance(1, 2)) {
          rings.ring({{x, y}, {x + 1, y + 1}, {x, y + 1}});
        } else {
          rings.ring({{x, y}, {x + 1, y}, {x, y + 1}});
        }
      }
    }
    expect_same_region(rings, kSize);
    if (HasFatalFailure()) FAIL() << round;
  }
}

TEST(Sweep, LoopsOfRandomCells) {
  // Star-shaped about the middle, so that loops are simple; many vertices lie above each other.
  Random random(12);
  for (int round = 0; round < 400; ++round) {
    const int n = 5 + static_cast<int>(random.below(40));
    Rings::Points loop;
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185307 * i / n, r = random.between(4, 12);
      const std::pair<int, int> point{12 + static_cast<int>(std::round(r * std::cos(angle))),
                                      12 + static_cast<int>(std::round(r * std::sin(angle)))};
      if (loop.empty() || loop.back() != point) loop.push_back(point);
    }
    if (loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3) continue;
    expect_same_region(Rings().ring(loop), 24);
    if (HasFatalFailure()) FAIL() << round;
  }
}

TEST(Sweep, IslandsInLakesOnIslands) {
  // A loop, a hole whose ring comes back to a vertex, and holes that enclose an island.
  expect_same_region(Rings()
                         .ring({{0, 0}, {20, 0}, {20, 20}, {0, 20}})
                         .ring({{2, 2}, {8, 2}, {8, 4}, {4, 4}, {4, 8}, {8, 8}, {8, 10}, {2, 10}})
                         .ring({{8, 2}, {10, 2}, {10, 10}, {8, 10}, {8, 8}, {9, 6}, {8, 4}})
                         .ring({{5, 5}, {7, 5}, {6, 6}}),
                     20);
}

/// A square with k x k holes of eight corners, in a plane that no axis lies in.
Scene screen(int k) {
  Builder b;
  const auto at = [](double x, double y) { return Triple{x, y, x + 2 * y}; };
  std::vector<std::vector<Triple>> holes;
  static constexpr std::array<std::pair<int, int>, 8> kCorners{
      {{1, 0}, {2, 0}, {3, 1}, {3, 2}, {2, 3}, {1, 3}, {0, 2}, {0, 1}}};
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < k; ++j) {
      holes.emplace_back();
      for (const auto& [x, y] : kCorners)
        holes.back().push_back(at(4 * i + x + .5, 4 * j + y + .5));
    }
  }
  const double size = 4.0 * k;
  b.polygon({at(0, 0), at(size, 0), at(size, size), at(0, size)}, holes);
  return b.scene();
}

TEST(Sweep, OfAPerforatedScreenIsExactAndQuick) {
  const Scene scene = screen(38);  // 1,444 holes, 11,556 corners
  const auto start = std::chrono::steady_clock::now();
  const auto prepared = prepare(scene);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(prepared);
  EXPECT_EQ(first_flaw(*prepared, scene), "");
  EXPECT_EQ(part_area_sum(*prepared, 0), input_area(*prepared, scene, 0));
  // It takes a tenth of a second; by bridges and ears it took minutes.
  EXPECT_LT(seconds.count(), 10);
}

TEST(Sweep, CanBeWatchedAndStopped) {
  const Scene scene = screen(38);
  std::atomic<bool> stop{false};
  double last = 0;
  const auto whole = prepare(scene, {&stop, [&](double done) {
                                       EXPECT_GE(done, last);
                                       last = done;
                                     }});
  ASSERT_TRUE(whole);
  EXPECT_EQ(last, 1);
  int told = 0;
  const auto stopped = prepare(scene, {&stop, [&](double) {
                                         ++told;
                                         stop = true;
                                       }});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace gnomon::test
