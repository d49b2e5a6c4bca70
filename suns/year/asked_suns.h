// SPDX-License-Identifier: GPL-3.0-or-later
// Suns as someone asks for them, in words, and the span of suns that this means for a scene. The
// names of members are those of the command's options and of the Python module's arguments.
#ifndef GNOMON_SUNS_YEAR_ASKED_SUNS_H
#define GNOMON_SUNS_YEAR_ASKED_SUNS_H

#include <optional>
#include <string>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"
#include "suns/year/year_of_suns.h"

namespace gnomon::suns {

struct AskedSuns {
  // Where: "LAT,LON" with hours from UTC, or a weather file; neither: where the scene says.
  std::string at, zone, weather;
  std::optional<double> elevation, north;
  // When: days such as 06-21 or 2026-06-21, and minutes.
  int year = 2025;
  std::string from, to;
  int step = 60;
  std::string sun_at{"middle"};  // start, middle or end of a step
  // Whose sun: erfa or energyplus.
  std::string sun_model{"erfa"};
  int average_days = 1;
  bool refraction = false;
  std::optional<double> pressure, temperature;
};

/// Whether its members go together, whatever the scene is. Errors: kUsage.
Expected<void> check_asked_suns(const AskedSuns& asked);

/// The suns that are asked for: of the place of `at`, `weather`, or the scene itself, in this
/// order. Errors: kUsage, and those of reading a weather file. Requires: check_asked_suns().
Expected<YearOptions> suns_asked(const AskedSuns& asked, const Scene& scene);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_YEAR_ASKED_SUNS_H
