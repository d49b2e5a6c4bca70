// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/calendar/read_time.h"

#include <gtest/gtest.h>

namespace gnomon::suns {
namespace {

using std::chrono::local_days;
using std::chrono::year;

TEST(ReadTime, TakesBackWhatIsWritten) {
  const CivilTime first = local_days(year(2024) / 1 / 1);
  for (Minutes since(15); since <= Minutes(366 * 24 * 60); since += Minutes(15)) {
    const CivilTime time = first + since;
    ASSERT_EQ(read_end_of_step(end_of_step_text(time), year(2024)).value(), time);
    const auto zoned = read_iso(iso_text(time, Minutes(-210)));
    ASSERT_EQ(zoned.value().time, time);
    ASSERT_EQ(zoned->zone, Minutes(-210));
  }
}

TEST(ReadTime, SaysWhatIsWrong) {
  EXPECT_EQ(read_end_of_step("1/2  3:00:00", year(2025)).value(),
            local_days(year(2025) / 1 / 2) + std::chrono::hours(3));
  EXPECT_EQ(read_end_of_step("02/29 01:00", year(2025)).error(), "is no day of the year 2025");
  EXPECT_EQ(read_end_of_step("01/01 24:15", year(2025)).error(), "is no time");
  EXPECT_EQ(read_iso("2026-03-20T06:30:00").error(), "has no zone");
  EXPECT_EQ(read_iso("2026-03-20T06:30:00Z").error(), "has no zone");
  EXPECT_EQ(read_iso("2026-03-20 06:30:00+01:00").error(), "is no time");
  EXPECT_EQ(read_iso("2026-03-32T06:30:00+01:00").error(), "is no day of the year 2026");
}

}  // namespace
}  // namespace gnomon::suns
