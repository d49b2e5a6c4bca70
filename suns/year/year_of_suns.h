// SPDX-License-Identifier: GPL-3.0-or-later
// The suns of a span of time in equal steps, as exact directions: decimals of six digits, which are
// within 0.00005 degrees of what a model says, and give a scene's numbers few bits.
#ifndef GNOMON_SUNS_YEAR_YEAR_OF_SUNS_H
#define GNOMON_SUNS_YEAR_YEAR_OF_SUNS_H

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"
#include "suns/calendar/civil_time.h"
#include "suns/place/place.h"
#include "suns/position/refraction.h"
#include "suns/position/sun_model.h"

namespace gnomon::suns {

/// Where in a step the sun is looked at.
enum class SunAt : std::uint8_t { kStart, kMiddle, kEnd };

struct YearOptions {
  Place place;
  std::chrono::local_days first, last;  // both days are in it
  Minutes step{60};                     // divides a day
  SunAt sun_at = SunAt::kMiddle;
  SunModelId model = SunModelId::kErfa;
  int average_days = 1;  // kEnergyPlus
  bool refraction = false;
  Air air;
  double north = 0;  // degrees from north, clockwise, to where the scene's y axis points
};

/// Millionths: along the scene's x and y, and up.
using Direction = std::array<std::int32_t, 3>;

struct SunTime {
  CivilTime end;  // of the step
  CivilTime at;   // where the sun is looked at
  Direction direction{};
  SunAngles angles;  // in the world, with refraction if that was asked for
  bool is_day = false;
};

/// All steps from midnight of the first day to that of the last. A sun at the horizon or below, by
/// its direction in millionths, is night; of EnergyPlus one that is less than 1e-5 up, as there.
/// Errors: kUsage (a step that does not divide a day, `last` before `first`, no sun for the year).
Expected<std::vector<SunTime>> year_of_suns(const YearOptions& options);

/// The same at single times, whatever the span is. Errors: kUsage (no sun for the year).
Expected<std::vector<SunTime>> suns_at(const YearOptions& options,
                                       std::span<const CivilTime> times);

/// The sun as a light of a scene, exactly, with its time as its name. Requires: is_day.
Light light_of(const SunTime& sun, Minutes zone);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_YEAR_YEAR_OF_SUNS_H
