// SPDX-License-Identifier: GPL-3.0-or-later
// Times as tables have them, back from their texts (civil_time.h writes them).
#ifndef GNOMON_SUNS_CALENDAR_READ_TIME_H
#define GNOMON_SUNS_CALENDAR_READ_TIME_H

#include <chrono>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "suns/calendar/civil_time.h"

namespace gnomon::suns {

/// What is wrong with a time: 'is no time', 'is no day of the year 2025'.
using WrongTime = std::string;

/// "03/20 06:30" of a year, with 24:00 as the midnight that ends the day; seconds may follow if
/// they are none.
tl::expected<CivilTime, WrongTime> read_end_of_step(std::string_view text, std::chrono::year year);

struct ZonedTime {
  CivilTime time;
  Minutes zone;
};
/// "2026-03-20T06:30:00-07:00".
tl::expected<ZonedTime, WrongTime> read_iso(std::string_view text);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_CALENDAR_READ_TIME_H
