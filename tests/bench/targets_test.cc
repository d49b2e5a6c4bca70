// SPDX-License-Identifier: GPL-3.0-or-later
// What the targets read from a command: its times, and the shares of its results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "targets/command.h"
#include "targets/result_shares.h"
#include "targets/suns.h"

namespace gnomon::bench {
namespace {

TEST(BenchPhases, AreReadFromTheStatistics) {
  const auto phases = parse_phases(
      "kernel plane, algorithm sectors\n"
      "CPU seconds (elapsed): reading 0.00829 (0.0131), preparation 5.1e-05 (0.1), shadows "
      "1.23e+03 (2), of these scene BSP 0.5, output 0.0219 (0.022)\n"
      "peak memory: 20 MiB\n");
  ASSERT_TRUE(phases);
  EXPECT_EQ(phases->reading, 0.00829);
  EXPECT_EQ(phases->preparation, 5.1e-05);
  EXPECT_EQ(phases->shadows, 1230);
  EXPECT_EQ(phases->output, 0.0219);
}

TEST(BenchPhases, NoneWhereOneIsMissing) {
  EXPECT_FALSE(parse_phases(""));
  EXPECT_FALSE(parse_phases("peak memory: 20 MiB\n"));
  EXPECT_FALSE(
      parse_phases("CPU seconds (elapsed): reading 1 (1), preparation 1 (1), shadows 1\n"
                   "output 0.0219 (0.022)\n"));
  EXPECT_FALSE(
      parse_phases("CPU seconds (elapsed): reading x (1), preparation 1 (1), shadows 1, "
                   "output 1\n"));
}

/// A result of one light and two polygons with these lit shares.
std::string result(const std::string& first, const std::string& second) {
  return R"({"lights": [{"id": "lamp", "polygons": [)"
         R"({"id": "a", "side": "front", "lit": {)" +
         first + R"(}}, {"id": "b", "side": "back", "lit": {)" + second + "}}]}]}";
}

TEST(BenchShares, RationalsHaveAChecksum) {
  const auto a = parse_shares(result(R"("fraction": "1/3")", R"("fraction": "0")")),
             b = parse_shares(result(R"("fraction": "1/3", "area": 2)", R"("fraction": "0")")),
             c = parse_shares(result(R"("fraction": "1/3")", R"("fraction": "1")"));
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->size(), 2u);
  EXPECT_EQ(a->at("lamp a front").exact, "1/3");
  EXPECT_EQ(checksum(*a), checksum(*b));
  EXPECT_NE(checksum(*a), checksum(*c));
}

TEST(BenchShares, BoundsOverlapOrNot) {
  const std::string one = R"("fraction": 1)";
  const auto shares = [&](const std::string& first) { return *parse_shares(result(first, one)); };
  const ResultShares wide = shares(R"("fraction": 0.5, "enclosure": [0.25, 0.75])"),
                     high = shares(R"("fraction": 0.8, "enclosure": [0.75, 0.85])"),
                     low = shares(R"("fraction": 0.2, "enclosure": [0.1, 0.24])"),
                     // Bounds as close as this are left out.
      half = shares(R"("fraction": 0.5)"), near_half = shares(R"("fraction": 0.5000000000005)"),
                     beside_half = shares(R"("fraction": 0.50000000001)");
  EXPECT_TRUE(bounds_overlap(wide, high));
  EXPECT_TRUE(bounds_overlap(wide, half));
  EXPECT_TRUE(bounds_overlap(half, near_half));
  EXPECT_FALSE(bounds_overlap(wide, low));
  EXPECT_FALSE(bounds_overlap(high, low));
  EXPECT_FALSE(bounds_overlap(half, beside_half));
}

TEST(BenchShares, OtherPolygonsAreADifference) {
  const ResultShares two = *parse_shares(result(R"("fraction": 1)", R"("fraction": 1)"));
  ResultShares one = two;
  one.erase("lamp b back");
  EXPECT_FALSE(bounds_overlap(two, one));
  EXPECT_FALSE(bounds_overlap(one, two));
  one["lamp c back"] = two.at("lamp b back");
  EXPECT_FALSE(bounds_overlap(two, one));
}

TEST(BenchShares, NoneInWhatIsNoResult) {
  EXPECT_FALSE(parse_shares(""));
  EXPECT_FALSE(parse_shares("[]"));
  EXPECT_FALSE(parse_shares(R"({"polygons": []})"));
  EXPECT_FALSE(parse_shares(R"({"lights": [{"id": "lamp"}]})"));
  EXPECT_FALSE(parse_shares(result(R"("fraction": true)", R"("fraction": 1)")));
  EXPECT_FALSE(parse_shares(result(R"("area": 1)", R"("fraction": 1)")));
  EXPECT_FALSE(parse_shares(result(R"("fraction": 1, "enclosure": [1])", R"("fraction": 1)")));
}

TEST(BenchSuns, StandAboveTheHorizonAndDiffer) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{100}, kHoursOfSun}) {
    auto suns = suns_of_a_year(count);
    ASSERT_EQ(suns.size(), count);
    for (const auto& sun : suns) {
      EXPECT_GT(sun[2], 0);
      EXPECT_NEAR(std::hypot(sun[0], sun[1], sun[2]), 10'000, 2);
    }
    if (count > 100) continue;
    std::ranges::sort(suns);
    EXPECT_EQ(std::ranges::adjacent_find(suns), suns.end());
  }
}

TEST(BenchSuns, RunFromEastToWestThroughTheSouth) {
  // The first day's, in winter: eight hours.
  const auto suns = suns_of_a_year(kHoursOfSun);
  EXPECT_GT(suns[0][0], 0);
  EXPECT_LT(suns[7][0], 0);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LT(suns[i][1], 0);
}

}  // namespace
}  // namespace gnomon::bench
