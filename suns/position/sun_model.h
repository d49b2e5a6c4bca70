// SPDX-License-Identifier: GPL-3.0-or-later
// The sun's direction at a place and a time of its standard clock, by one of several models.
#ifndef GNOMON_SUNS_POSITION_SUN_MODEL_H
#define GNOMON_SUNS_POSITION_SUN_MODEL_H

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "suns/calendar/civil_time.h"
#include "suns/place/place.h"

namespace gnomon::suns {

enum class SunModelId : std::uint8_t {
  kErfa,        // the IAU's routines: within 0.0003 degrees of NREL's Solar Position Algorithm
  kEnergyPlus,  // the series of EnergyPlus: off by up to 0.64 degrees, see energyplus_sun.cc
};
std::optional<SunModelId> sun_model_by_name(std::string_view name);
std::string_view name_of(SunModelId model);

/// Both in degrees: from north clockwise, and over the horizon, without air.
struct SunAngles {
  double azimuth = 0, altitude = 0;
};

/// Of length 1: east, north, up.
using SunVector = std::array<double, 3>;
SunVector vector_of(const SunAngles& angles);
SunAngles angles_of(const SunVector& vector);

/// Seen from the place itself (topocentric), with UT1 taken as UTC (less than a second apart). For
/// times beyond the known leap seconds the last known number of them is taken. Errors: kUsage
/// (before the year 1960, for which UTC is not defined, or after 2500).
Expected<SunVector> erfa_sun(const Place& place, CivilTime time);

/// As EnergyPlus computes it: declination and equation of time are those of the day, of
/// `average_days` > 1 the means over that many days from the day `first` on, as its default of 20
/// does. Requires: average_days >= 1.
SunVector energyplus_sun(const Place& place, CivilTime time, std::chrono::local_days first,
                         int average_days);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_POSITION_SUN_MODEL_H
