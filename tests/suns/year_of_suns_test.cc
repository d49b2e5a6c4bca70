// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/year/year_of_suns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::suns {
namespace {

YearOptions phoenix() {
  YearOptions options;
  options.place.latitude = 33.45;
  options.place.longitude = -111.983;
  options.place.zone = Minutes(-420);
  options.first = std::chrono::local_days(std::chrono::year(2026) / 1 / 1);
  options.last = std::chrono::local_days(std::chrono::year(2026) / 12 / 31);
  return options;
}

TEST(YearOfSuns, HasAllHours) {
  const auto suns = year_of_suns(phoenix()).value();
  ASSERT_EQ(suns.size(), 8760u);
  const auto day = std::ranges::count_if(suns, &SunTime::is_day);
  EXPECT_GT(day, 4300);
  EXPECT_LT(day, 4450);
  EXPECT_EQ(iso_text(suns.front().at, Minutes(-420)), "2026-01-01T00:30:00-07:00");
  EXPECT_EQ(end_of_step_text(suns.back().end), "12/31 24:00");
  for (const SunTime& sun : suns) {
    const double length = std::hypot(sun.direction[0], sun.direction[1], sun.direction[2]);
    ASSERT_NEAR(length, 1e6, 2);
    ASSERT_EQ(sun.is_day, sun.direction[2] > 0);
  }
}

TEST(YearOfSuns, LeapYearsAndSteps) {
  YearOptions options = phoenix();
  options.first = std::chrono::local_days(std::chrono::year(2024) / 1 / 1);
  options.last = std::chrono::local_days(std::chrono::year(2024) / 12 / 31);
  options.step = Minutes(15);
  EXPECT_EQ(year_of_suns(options).value().size(), 366u * 96);
  options.last = options.first;
  options.sun_at = SunAt::kEnd;
  const auto day = year_of_suns(options).value();
  ASSERT_EQ(day.size(), 96u);
  EXPECT_EQ(day.front().at, options.first + Minutes(15));
  EXPECT_EQ(day.back().at, options.first + std::chrono::days(1));
  options.step = Minutes(7);
  EXPECT_FALSE(year_of_suns(options));
  options.step = Minutes(60);
  options.last = options.first - std::chrono::days(1);
  EXPECT_FALSE(year_of_suns(options));
}

TEST(YearOfSuns, PolarNight) {
  YearOptions options = phoenix();
  options.place.latitude = 80;
  options.first = std::chrono::local_days(std::chrono::year(2026) / 12 / 15);
  const auto suns = year_of_suns(options).value();
  EXPECT_TRUE(std::ranges::none_of(suns, &SunTime::is_day));
}

/// Turned by 90 degrees, the scene's y axis points east.
TEST(YearOfSuns, North) {
  YearOptions options = phoenix();
  options.last = options.first;
  const auto world = year_of_suns(options).value();
  options.north = 90;
  const auto turned = year_of_suns(options).value();
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_NEAR(turned[i].direction[1], world[i].direction[0], 1);
    EXPECT_NEAR(turned[i].direction[0], -world[i].direction[1], 1);
    EXPECT_EQ(turned[i].direction[2], world[i].direction[2]);
  }
}

TEST(YearOfSuns, Refraction) {
  YearOptions options = phoenix();
  const auto without = year_of_suns(options).value();
  options.refraction = true;
  const auto with = year_of_suns(options).value();
  EXPECT_GE(std::ranges::count_if(with, &SunTime::is_day),
            std::ranges::count_if(without, &SunTime::is_day));
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (without[i].angles.altitude < 0) continue;
    EXPECT_GT(with[i].angles.altitude, without[i].angles.altitude);
    EXPECT_LT(with[i].angles.altitude, without[i].angles.altitude + 0.6);
  }
}

TEST(YearOfSuns, AveragedSunsAreOneDirection) {
  YearOptions options = phoenix();
  options.model = SunModelId::kEnergyPlus;
  options.average_days = 20;
  options.last = options.first + std::chrono::days(39);
  const auto suns = year_of_suns(options).value();
  for (std::size_t hour = 0; hour < 24; ++hour) {
    EXPECT_EQ(suns[hour].direction, suns[19 * 24 + hour].direction);
    EXPECT_NE(suns[hour].direction, suns[20 * 24 + hour].direction);
  }
}

TEST(YearOfSuns, LightsAreExactDecimals) {
  YearOptions options = phoenix();
  options.last = options.first;
  const auto suns = year_of_suns(options).value();
  const Light light = light_of(suns[12], Minutes(-420));
  EXPECT_EQ(light.id, "2026-01-01T12:30:00-07:00");
  EXPECT_TRUE(light.is_directional());
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(light.position[k].exact() * 1000000, suns[12].direction[k]);
  }
}

}  // namespace
}  // namespace gnomon::suns
