// SPDX-License-Identifier: GPL-3.0-or-later
// Times of a place's standard clock (no summer time), to the second, and how they are written.
#ifndef GNOMON_SUNS_CALENDAR_CIVIL_TIME_H
#define GNOMON_SUNS_CALENDAR_CIVIL_TIME_H

#include <chrono>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon::suns {

/// Since 1970-01-01 00:00 of the place's own clock.
using CivilTime = std::chrono::local_time<std::chrono::seconds>;
using Minutes = std::chrono::minutes;

/// The day that a time is in, from midnight on.
std::chrono::local_days day_of(CivilTime time);
/// 1 for the 1st of January.
int day_of_year(CivilTime time);
std::chrono::year_month_day date_of(CivilTime time);

/// "2026-03-20T06:30:00-07:00": ISO 8601 with the zone's distance from UTC.
std::string iso_text(CivilTime time, Minutes zone);
/// "03/20 06:30", with midnight as 24:00 of the day that ends, as energy engines write the end of a
/// step.
std::string end_of_step_text(CivilTime time);

/// A day as "MM-DD", of `year`, or as "YYYY-MM-DD". `what` names it in errors. Errors: kUsage.
Expected<std::chrono::local_days> parse_day(std::string_view text, std::chrono::year year,
                                            std::string_view what);
/// Hours before or after UTC: "-7", "5.5", "+05:30". Errors: kUsage.
Expected<Minutes> parse_zone(std::string_view text, std::string_view what);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_CALENDAR_CIVIL_TIME_H
