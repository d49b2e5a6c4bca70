// SPDX-License-Identifier: GPL-3.0-or-later
// A place on the Earth and its clock.
#ifndef GNOMON_SUNS_PLACE_PLACE_H
#define GNOMON_SUNS_PLACE_PLACE_H

#include <chrono>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon::suns {

struct Place {
  std::string name;
  double latitude = 0, longitude = 0;  // degrees, north and east positive
  std::chrono::minutes zone{0};        // of the standard clock, from UTC
  double elevation = 0;                // metres above sea level
};

/// "33.45,-111.98": latitude and longitude in degrees. Errors: kUsage.
Expected<Place> parse_place(std::string_view text, std::string_view what);
/// Whether latitude, longitude and elevation are those of a place. Errors: kUsage.
Expected<void> check_place(const Place& place, std::string_view what);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_PLACE_PLACE_H
