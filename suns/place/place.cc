// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/place/place.h"

#include <charconv>
#include <cmath>

namespace gnomon::suns {

Expected<Place> parse_place(std::string_view text, std::string_view what) {
  Place place;
  const char *at = text.data(), *end = at + text.size();
  auto read = std::from_chars(at, end, place.latitude);
  bool is_place = read.ec == std::errc() && read.ptr != end && *read.ptr == ',';
  if (is_place) {
    read = std::from_chars(read.ptr + 1, end, place.longitude);
    is_place = read.ec == std::errc() && read.ptr == end;
  }
  if (!is_place) {
    return fail(ErrorCode::kUsage, std::string(what) + " " + std::string(text) + ": no place",
                "LATITUDE,LONGITUDE in degrees, north and east positive, such as 33.45,-111.98");
  }
  if (auto checked = check_place(place, what); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  return place;
}

Expected<void> check_place(const Place& place, std::string_view what) {
  const auto hold = [&](const char* name, double value, double least, double most,
                        const char* expected) -> Expected<void> {
    if (value >= least && value <= most) return {};
    return fail(ErrorCode::kUsage, std::string(what) + ": no " + name, expected);
  };
  if (auto held = hold("latitude", place.latitude, -90, 90, "from -90 to 90 degrees"); !held) {
    return held;
  }
  if (auto held = hold("longitude", place.longitude, -180, 180,
                       "from -180 to 180 degrees, east "
                       "positive");
      !held) {
    return held;
  }
  // From the lowest shore to above the highest summit.
  return hold("elevation", place.elevation, -500, 9000, "metres above the sea, from -500 to 9000");
}

}  // namespace gnomon::suns
