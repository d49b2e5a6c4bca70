// SPDX-License-Identifier: GPL-3.0-or-later
#include "targets/suns.h"

#include <cmath>
#include <numbers>

namespace gnomon::bench {
namespace {

using Direction = std::array<std::int64_t, 3>;

/// Hour angle and declination in radians.
Direction towards_sun(double hour_angle, double declination) {
  constexpr double kLatitude = 48 * std::numbers::pi / 180, kLength = 10'000;
  const double east = -std::cos(declination) * std::sin(hour_angle),
               north = std::cos(kLatitude) * std::sin(declination) -
                       std::sin(kLatitude) * std::cos(declination) * std::cos(hour_angle),
               up = std::sin(kLatitude) * std::sin(declination) +
                    std::cos(kLatitude) * std::cos(declination) * std::cos(hour_angle);
  return {std::llround(kLength * east), std::llround(kLength * north), std::llround(kLength * up)};
}

}  // namespace

std::vector<Direction> suns_of_a_year(std::size_t count) {
  constexpr double kTurn = 2 * std::numbers::pi, kTilt = 23.44 * std::numbers::pi / 180;
  constexpr int kDays = 365, kHours = 24, kDaysFromSolstice = 10;
  std::vector<Direction> all;
  for (int day = 0; day < kDays; ++day) {
    const double declination = -kTilt * std::cos(kTurn * (day + kDaysFromSolstice + 0.5) / kDays);
    for (int hour = 0; hour < kHours; ++hour) {
      const Direction sun = towards_sun(kTurn * (hour + 0.5 - 12) / kHours, declination);
      if (sun[2] > 0) all.push_back(sun);
    }
  }
  std::vector<Direction> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * all.size() / count]);
  return chosen;
}

}  // namespace gnomon::bench
