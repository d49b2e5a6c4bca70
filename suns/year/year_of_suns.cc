// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/year/year_of_suns.h"

#include <cmath>

namespace gnomon::suns {

namespace {

namespace chrono = std::chrono;

Expected<void> check(const YearOptions& options) {
  constexpr Minutes kDay{24 * 60};
  if (options.step < Minutes(1) || options.step > kDay || kDay % options.step != Minutes(0)) {
    return fail(
        ErrorCode::kUsage,
        "a step of " + std::to_string(options.step.count()) + " minutes does not divide a day",
        "1, 2, 3, 4, 5, 6, 10, 12, 15, 20, 30, 60, ... minutes");
  }
  if (options.last < options.first) {
    return fail(ErrorCode::kUsage, "the last day is before the first", "--from no later than --to");
  }
  return {};
}

Expected<SunVector> sun_at(const YearOptions& options, CivilTime time) {
  if (options.model == SunModelId::kErfa) return erfa_sun(options.place, time);
  // Periods of so many days begin at the first one.
  const auto days = (day_of(time) - options.first).count();
  const auto period = days - days % options.average_days;
  return energyplus_sun(options.place, time, options.first + chrono::days(period),
                        options.average_days);
}

/// Turned from the world's north to the scene's, and rounded.
Direction direction_of(const SunAngles& angles, double north) {
  const SunVector vector = vector_of({angles.azimuth - north, angles.altitude});
  Direction result;
  for (int k = 0; k < 3; ++k) result[k] = static_cast<std::int32_t>(std::lround(1e6 * vector[k]));
  return result;
}

/// Where the sun is at a time, and whether it is up.
Expected<void> set_sun(const YearOptions& options, CivilTime time, SunTime& sun) {
  auto vector = sun_at(options, time);
  if (!vector) return tl::unexpected(std::move(vector.error()));
  sun.angles = angles_of(*vector);
  if (options.refraction) sun.angles.altitude += refraction(sun.angles.altitude, options.air);
  sun.direction = direction_of(sun.angles, options.north);
  const std::int32_t least = options.model == SunModelId::kEnergyPlus ? 10 : 1;
  sun.is_day = sun.direction[2] >= least;
  return {};
}

}  // namespace

Expected<std::vector<SunTime>> year_of_suns(const YearOptions& options) {
  if (auto checked = check(options); !checked) return tl::unexpected(std::move(checked.error()));
  const chrono::seconds before_end = options.sun_at == SunAt::kStart ? options.step
                                     : options.sun_at == SunAt::kMiddle
                                         ? chrono::seconds(options.step) / 2
                                         : chrono::seconds(0);
  std::vector<SunTime> suns;
  const CivilTime last = options.last + chrono::days(1);
  for (CivilTime end = options.first + options.step; end <= last; end += options.step) {
    SunTime sun;
    sun.end = end;
    sun.at = end - before_end;
    // The last step of a day ends at midnight, which is still that day's.
    const bool is_midnight = sun.at == last;
    auto set = set_sun(options, is_midnight ? sun.at - chrono::seconds(1) : sun.at, sun);
    if (!set) return tl::unexpected(std::move(set.error()));
    suns.push_back(sun);
  }
  return suns;
}

Expected<std::vector<SunTime>> suns_at(const YearOptions& options,
                                       std::span<const CivilTime> times) {
  std::vector<SunTime> suns(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    suns[i].end = suns[i].at = times[i];
    auto set = set_sun(options, times[i], suns[i]);
    if (!set) return tl::unexpected(std::move(set.error()));
  }
  return suns;
}

Light light_of(const SunTime& sun, Minutes zone) {
  Light light;
  light.id = iso_text(sun.at, zone);
  light.type = LightType::kDirectional;
  for (int k = 0; k < 3; ++k) {
    light.position[k] = Number::from_short_decimal(sun.direction[k], -6);
  }
  return light;
}

}  // namespace gnomon::suns
