// SPDX-License-Identifier: GPL-3.0-or-later
// The search of pairs finds what a test of every two boxes finds, each pair once, and the same rows
// on every level of vector instructions and any number of threads.
#include "algorithms/contour/pair_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/contour/lanes/simd_level.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float unit(Random& random) { return std::ldexp(static_cast<float>(random.below(1 << 24)), -24); }

struct Boxes {
  std::vector<float> low_u, low_v, high_u, high_v;
  std::vector<std::uint32_t> owners;

  void add(float u, float v, float width, float height) { add_ends(u, v, u + width, v + height); }
  void add_ends(float u0, float v0, float u1, float v1) {
    low_u.push_back(u0);
    low_v.push_back(v0);
    high_u.push_back(u1);
    high_v.push_back(v1);
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(low_u.size()); }
  ChartBoxes chart() const { return {low_u, low_v, high_u, high_v, owners}; }
  bool overlap(std::uint32_t i, std::uint32_t k) const {
    return low_u[i] <= high_u[k] && low_u[k] <= high_u[i] && low_v[i] <= high_v[k] &&
           low_v[k] <= high_v[i];
  }
};

using Rows = std::vector<std::vector<std::uint32_t>>;

/// The rows of neighbours, each rising, by a test of every two boxes of a chart.
Rows rows_by_brute_force(const std::vector<Boxes>& charts, std::uint32_t owners,
                         const std::vector<std::uint8_t>& casts) {
  std::vector<std::set<std::uint32_t>> sets(owners);
  for (const Boxes& boxes : charts) {
    const ChartBoxes chart = boxes.chart();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      for (std::uint32_t k = 0; k < boxes.size(); ++k) {
        const std::uint32_t a = chart.owner(i), b = chart.owner(k);
        if (i == k || !boxes.overlap(i, k)) continue;
        if (casts.empty() || casts[a] != 0 || casts[b] != 0) sets[a].insert(b);
      }
    }
  }
  Rows rows;
  for (const auto& set : sets) rows.emplace_back(set.begin(), set.end());
  return rows;
}

/// The rows as they are found; checks that they are the same with one and with two threads.
Rows rows_of(PairSearch& search, const std::vector<Boxes>& charts, std::uint32_t owners,
             const std::vector<std::uint8_t>& casts = {}) {
  std::vector<ChartBoxes> views;
  for (const Boxes& boxes : charts) views.push_back(boxes.chart());
  std::array<Rows, 2> results;
  for (unsigned jobs = 1; jobs <= 2; ++jobs) {
    PairOptions options;
    options.casts = casts;
    options.jobs = jobs;
    tbb::task_arena arena(static_cast<int>(jobs));
    EXPECT_TRUE(arena.execute([&] { return search.run(views, owners, options); }));
    EXPECT_EQ(search.first().size(), owners + 1);
    for (std::uint32_t i = 0; i < owners; ++i) {
      const auto row = search.neighbours(i);
      results[jobs - 1].emplace_back(row.begin(), row.end());
    }
  }
  EXPECT_EQ(results[0], results[1]);
  return results[0];
}

class PairSearchTest : public testing::TestWithParam<SimdLevel> {
 protected:
  /// Tests rows against brute force, and that the order in them is that of the baseline.
  void check(const std::vector<Boxes>& charts, std::uint32_t owners,
             const std::vector<std::uint8_t>& casts = {}) {
    Rows rows = rows_of(search_, charts, owners, casts);
    EXPECT_EQ(rows, rows_of(baseline_, charts, owners, casts));
    for (auto& row : rows) std::ranges::sort(row);
    EXPECT_EQ(rows, rows_by_brute_force(charts, owners, casts));
  }
  void check(const Boxes& boxes, const std::vector<std::uint8_t>& casts = {}) {
    check(std::vector<Boxes>{boxes}, boxes.size(), casts);
  }

  PairSearch search_{lanes(GetParam())};
  PairSearch baseline_{lanes(SimdLevel::kBaseline)};
};

INSTANTIATE_TEST_SUITE_P(Levels, PairSearchTest, testing::ValuesIn(simd_levels()),
                         [](const auto& info) { return std::string(name_of(info.param)); });

/// Adds one random box to boxes of about n.
using Kind = std::function<void(Random&, float n, Boxes&)>;

const std::vector<std::pair<const char*, Kind>>& kinds() {
  static const auto add_quad = [](Random& random, float n, Boxes& boxes) {
    const float size = std::sqrt(3 / n);
    boxes.add(unit(random), unit(random), size * unit(random), size * unit(random));
  };
  static const std::vector<std::pair<const char*, Kind>> kKinds = {
      {"quads", add_quad},
      {"with ground",
       [](Random& random, float n, Boxes& boxes) {
         if (boxes.size() == 5) {
           boxes.add(-1, -1, 3, 3);
         } else {
           add_quad(random, n, boxes);
         }
       }},
      {"tall", [](Random& random, float n,
                  Boxes& boxes) { boxes.add(unit(random), unit(random), 1 / n, unit(random)); }},
      {"wide", [](Random& random, float n,
                  Boxes& boxes) { boxes.add(unit(random), unit(random), unit(random), 1 / n); }},
      {"tall, wide and small",
       [](Random& random, float n, Boxes& boxes) {
         switch (boxes.size() % 3) {
           case 0:
             return boxes.add(3 + unit(random), unit(random) / 8, 0, 1);
           case 1:
             return boxes.add(3 + unit(random) / 8, 2 + unit(random), 1, 0);
           default:
             return add_quad(random, n, boxes);
         }
       }},
      {"of every height",
       [](Random& random, float n, Boxes& boxes) {
         boxes.add(unit(random), unit(random), 2 / n, std::exp(-12 * unit(random)));
       }},
      {"clusters",
       [](Random& random, float n, Boxes& boxes) {
         const auto place = static_cast<float>(random.below(5));
         const float scale = std::ldexp(1.0f, -static_cast<int>(4 * place));
         boxes.add(place + scale * unit(random), 1000 * place + scale * unit(random),
                   scale * unit(random) / std::sqrt(n), scale * unit(random) / std::sqrt(n));
       }},
      {"lattice",
       [](Random& random, float n, Boxes& boxes) {
         const auto side = static_cast<std::uint64_t>(std::sqrt(n)) + 1;
         boxes.add(static_cast<float>(random.below(side)), static_cast<float>(random.below(side)),
                   static_cast<float>(random.below(2)), static_cast<float>(random.below(2)));
       }},
      {"points",
       [](Random& random, float, Boxes& boxes) { boxes.add(unit(random), unit(random), 0, 0); }},
      {"signed zeros",
       [](Random& random, float, Boxes& boxes) {
         const float zero = random.below(2) == 0 ? 0.0f : -0.0f;
         const float other = random.below(2) == 0 ? 0.0f : -0.0f;
         const float v = static_cast<float>(random.below(50)) - 25;
         if (random.below(2) == 0) {
           boxes.add_ends(zero, v, other, v);
         } else {
           boxes.add_ends(v, zero, v, other);
         }
       }},
      {"infinite",
       [](Random& random, float n, Boxes& boxes) {
         add_quad(random, n, boxes);
         if (random.below(10) == 0) boxes.low_u.back() = -kInfinity;
         if (random.below(10) == 0) boxes.low_v.back() = -kInfinity;
         if (random.below(10) == 0) boxes.high_u.back() = kInfinity;
         if (random.below(10) == 0) boxes.high_v.back() = kInfinity;
         if (random.below(100) == 0) boxes.low_u.back() = boxes.high_u.back();
         if (random.below(100) == 0) boxes.low_v.back() = boxes.high_v.back();
       }},
      {"very far",
       [](Random& random, float n, Boxes& boxes) {
         add_quad(random, n, boxes);
         if (random.below(50) == 0) boxes.high_v.back() = 3e38f;
         if (random.below(50) == 0) boxes.low_u.back() = -3e38f;
       }},
  };
  return kKinds;
}

TEST_P(PairSearchTest, RowsAreThoseOfBruteForce) {
  Random random(1);
  for (const auto& [name, add] : kinds()) {
    for (const std::uint32_t n : {1u, 2u, 7u, 40u, 127u, 128u, 300u, 1000u, 3000u}) {
      Boxes boxes;
      while (boxes.size() < n) add(random, static_cast<float>(n), boxes);
      SCOPED_TRACE(name);
      check(boxes);
      if (HasFailure()) return;
    }
  }
}

TEST_P(PairSearchTest, TwoThatDoNotCastAreNoPair) {
  Random random(2);
  for (const auto& [name, add] : kinds()) {
    Boxes boxes;
    std::vector<std::uint8_t> casts;
    while (boxes.size() < 700) {
      add(random, 700, boxes);
      casts.push_back(random.below(3) == 0);
    }
    SCOPED_TRACE(name);
    check(boxes, casts);
    check(boxes, std::vector<std::uint8_t>(casts.size(), 0));
    check(boxes, std::vector<std::uint8_t>(casts.size(), 1));
  }
}

TEST_P(PairSearchTest, EqualBoxesAreAllPairs) {
  for (const auto& [low, high] : {std::pair(0.5f, 0.5f), {-1.0f, 1.0f}, {-kInfinity, kInfinity}}) {
    Boxes boxes;
    while (boxes.size() < 500) boxes.add_ends(low, low, high, high);
    check(boxes);
  }
}

TEST_P(PairSearchTest, NothingHasNoRows) {
  check(Boxes());
  check(std::vector<Boxes>{}, 0);
  check(std::vector<Boxes>{}, 3);
  check(std::vector<Boxes>(3), 2);
}

/// Boxes of some of `owners` in some of `charts` charts.
std::vector<Boxes> random_charts(Random& random, const Kind& add, std::size_t charts,
                                 std::uint32_t owners) {
  std::vector<Boxes> result(charts);
  for (std::uint32_t owner = 0; owner < owners; ++owner) {
    for (Boxes& boxes : result) {
      if (random.below(charts) > 1) continue;
      add(random, static_cast<float>(owners), boxes);
      boxes.owners.push_back(owner);
    }
  }
  return result;
}

TEST_P(PairSearchTest, APairOfSeveralChartsIsOne) {
  Random random(3);
  for (const auto& [name, add] : kinds()) {
    for (const std::uint32_t owners : {3u, 50u, 1500u}) {
      SCOPED_TRACE(name);
      check(random_charts(random, add, 6, owners), owners);
      check(random_charts(random, add, 2, owners), owners);
    }
  }
}

TEST_P(PairSearchTest, OwnersNeedNotBeInOrder) {
  Random random(4);
  Boxes boxes;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    kinds()[0].second(random, 1000, boxes);
    boxes.owners.push_back(2000 - 2 * i);
  }
  check({boxes}, 2001);
  check({boxes, boxes, boxes}, 2001);
}

TEST_P(PairSearchTest, ASearchForgetsTheOneBefore) {
  Random random(5);
  for (const std::uint32_t n : {2000u, 10u, 1000u, 3u, 500u}) {
    Boxes boxes;
    while (boxes.size() < n) kinds()[n % 3].second(random, static_cast<float>(n), boxes);
    check(boxes);
    check(random_charts(random, kinds()[0].second, 3, n), n);
  }
}

TEST_P(PairSearchTest, MoreThanTheMostPairsAreNone) {
  Boxes boxes;
  while (boxes.size() < 300) boxes.add(0, 0, 1, 1);
  const ChartBoxes chart = boxes.chart();
  PairOptions options;
  options.most_pairs = 300 * 299 / 2;
  EXPECT_TRUE(search_.run({&chart, 1}, 300, options));
  EXPECT_EQ(search_.neighbours().size(), 300u * 299);
  --options.most_pairs;
  EXPECT_FALSE(search_.run({&chart, 1}, 300, options));
  EXPECT_THAT(search_.neighbours(), IsEmpty());
  EXPECT_THAT(search_.neighbours(299), IsEmpty());
  check(boxes);
}

TEST_P(PairSearchTest, ABoxMayOnlyTouch) {
  Boxes boxes;
  boxes.add(0, 0, 1, 1);
  boxes.add(1, 1, 1, 1);
  boxes.add(2.5f, 0, 1, 9);
  check(boxes);
  EXPECT_THAT(search_.neighbours(0), ElementsAre(1));
}

/// Many boxes are compared between levels and numbers of threads only, and by the sum of a sample.
TEST_P(PairSearchTest, ManyBoxes) {
  constexpr std::uint32_t kCount = 70000;
  Random random(6);
  for (const auto& [name, add] : kinds()) {
    const std::string_view kind = name;
    if (kind == "wide" || kind == "tall" || kind == "infinite" || kind == "signed zeros") continue;
    Boxes boxes;
    while (boxes.size() < kCount) add(random, kCount, boxes);
    SCOPED_TRACE(name);
    Rows rows = rows_of(search_, {boxes}, kCount);
    EXPECT_EQ(rows, rows_of(baseline_, {boxes}, kCount));
    for (std::uint32_t i = 0; i < kCount; i += 1499) {
      std::ranges::sort(rows[i]);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t k = 0; k < kCount; ++k) {
        if (i != k && boxes.overlap(i, k)) expected.push_back(k);
      }
      ASSERT_EQ(rows[i], expected) << i;
    }
  }
}

}  // namespace
}  // namespace gnomon
