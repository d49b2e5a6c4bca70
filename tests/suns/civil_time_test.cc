// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/calendar/civil_time.h"

#include <gtest/gtest.h>

namespace gnomon::suns {
namespace {

using std::chrono::hours;
using std::chrono::local_days;
using std::chrono::minutes;
using std::chrono::seconds;
using std::chrono::year;

local_days day(int y, unsigned m, unsigned d) {
  return local_days(year(y) / static_cast<int>(m) / static_cast<int>(d));
}

TEST(CivilTime, IsWrittenWithItsZone) {
  EXPECT_EQ(iso_text(day(2026, 3, 20) + hours(6) + minutes(30), Minutes(-420)),
            "2026-03-20T06:30:00-07:00");
  EXPECT_EQ(iso_text(day(2024, 2, 29) + seconds(450), Minutes(345)), "2024-02-29T00:07:30+05:45");
  EXPECT_EQ(iso_text(day(2026, 1, 1), Minutes(-210)), "2026-01-01T00:00:00-03:30");
}

TEST(CivilTime, StepsEndAtMidnightOfTheirOwnDay) {
  EXPECT_EQ(end_of_step_text(day(2026, 1, 1) + hours(1)), "01/01 01:00");
  EXPECT_EQ(end_of_step_text(day(2026, 1, 2)), "01/01 24:00");
  EXPECT_EQ(end_of_step_text(day(2025, 1, 1)), "12/31 24:00");
  EXPECT_EQ(end_of_step_text(day(2026, 1, 1) + minutes(15)), "01/01 00:15");
}

TEST(CivilTime, DaysOfTheYear) {
  EXPECT_EQ(day_of_year(day(2025, 1, 1)), 1);
  EXPECT_EQ(day_of_year(day(2025, 12, 31) + hours(23)), 365);
  EXPECT_EQ(day_of_year(day(2024, 12, 31)), 366);
}

TEST(CivilTime, DaysAsTyped) {
  EXPECT_EQ(parse_day("06-21", year(2025), "--from").value(), day(2025, 6, 21));
  EXPECT_EQ(parse_day("2024-02-29", year(2025), "--from").value(), day(2024, 2, 29));
  for (const char* wrong : {"02-29", "2025-02-29", "13-01", "00-10", "6-21", "06-31", "june", "",
                            "2025-06", "06-21x", "+6-21", "2025/06/21"}) {
    const auto parsed = parse_day(wrong, year(2025), "--from");
    ASSERT_FALSE(parsed) << wrong;
    EXPECT_EQ(parsed.error().code, ErrorCode::kUsage);
    EXPECT_EQ(parsed.error().what.rfind("--from ", 0), 0u) << parsed.error().what;
  }
}

TEST(CivilTime, ZonesAsTyped) {
  EXPECT_EQ(parse_zone("-7", "--tz").value(), Minutes(-420));
  EXPECT_EQ(parse_zone("5.5", "--tz").value(), Minutes(330));
  EXPECT_EQ(parse_zone("+05:45", "--tz").value(), Minutes(345));
  EXPECT_EQ(parse_zone("-03:30", "--tz").value(), Minutes(-210));
  EXPECT_EQ(parse_zone("0", "--tz").value(), Minutes(0));
  for (const char* wrong : {"", "-", "15", "-14.5", "5.501", "5:3", "05:60", "PST", "--7", "1e3",
                            "nan", "+-7", ":30"}) {
    EXPECT_FALSE(parse_zone(wrong, "--tz")) << wrong;
  }
}

}  // namespace
}  // namespace gnomon::suns
