// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/calendar/civil_time.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace gnomon::suns {

namespace chrono = std::chrono;

namespace {

/// All of a text as a number.
template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

chrono::local_days day_of(CivilTime time) { return chrono::floor<chrono::days>(time); }

chrono::year_month_day date_of(CivilTime time) { return chrono::year_month_day(day_of(time)); }

int day_of_year(CivilTime time) {
  const chrono::year_month_day date = date_of(time);
  const chrono::local_days first{date.year() / chrono::January / 1};
  return static_cast<int>((day_of(time) - first).count()) + 1;
}

std::string iso_text(CivilTime time, Minutes zone) {
  const chrono::year_month_day date = date_of(time);
  const chrono::hh_mm_ss clock{time - day_of(time)};
  const auto minutes = static_cast<int>(std::abs(zone.count()));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}{:02}:{:02}",
                     static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), zone.count() < 0 ? '-' : '+',
                     minutes / 60, minutes % 60);
}

std::string end_of_step_text(CivilTime time) {
  const bool is_midnight = time == CivilTime(day_of(time));
  const CivilTime within = is_midnight ? time - chrono::seconds(1) : time;
  const chrono::year_month_day date = date_of(within);
  const chrono::hh_mm_ss clock{time - day_of(time)};
  return fmt::format("{:02}/{:02} {:02}:{:02}", static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()), is_midnight ? 24 : clock.hours().count(),
                     is_midnight ? 0 : clock.minutes().count());
}

Expected<chrono::local_days> parse_day(std::string_view text, chrono::year year,
                                       std::string_view what) {
  const auto wrong = [&](std::string_view why) {
    return fail(ErrorCode::kUsage,
                std::string(what) + " " + std::string(text) + ": " + std::string(why),
                "a day such as 06-21 or 2026-06-21");
  };
  std::string_view rest = text;
  if (rest.size() == 10 && rest[4] == '-') {
    if (!is_digits(rest.substr(0, 4))) return wrong("no day");
    year = chrono::year(*number<int>(rest.substr(0, 4)));
    rest.remove_prefix(5);
  }
  if (rest.size() != 5 || rest[2] != '-' || !is_digits(rest.substr(0, 2)) ||
      !is_digits(rest.substr(3))) {
    return wrong("no day");
  }
  const chrono::year_month_day date = year /
                                      static_cast<int>(*number<unsigned>(rest.substr(0, 2))) /
                                      static_cast<int>(*number<unsigned>(rest.substr(3)));
  if (!date.ok()) {
    return wrong(fmt::format("not a day of the year {}", static_cast<int>(year)));
  }
  return chrono::local_days(date);
}

Expected<Minutes> parse_zone(std::string_view text, std::string_view what) {
  constexpr double kFarthest = 14;  // hours; the widest zone that there is
  std::string_view rest = text;
  double sign = 1;
  if (!rest.empty() && (rest.front() == '+' || rest.front() == '-')) {
    sign = rest.front() == '-' ? -1 : 1;
    rest.remove_prefix(1);
  }
  std::optional<double> hours;
  if (const std::size_t colon = rest.find(':'); colon != std::string_view::npos) {
    const std::string_view minutes = rest.substr(colon + 1);
    if (is_digits(rest.substr(0, colon)) && is_digits(minutes) && minutes.size() == 2 &&
        *number<int>(minutes) < 60) {
      const auto whole = number<int>(rest.substr(0, colon));
      if (whole) hours = *whole + *number<int>(minutes) / 60.0;
    }
  } else if (!rest.empty() && rest.front() != '-' && rest.front() != '+') {
    hours = number<double>(rest);
  }
  const double minutes = hours ? sign * *hours * 60 : 0;
  if (!hours || !(std::fabs(minutes) <= 60 * kFarthest) ||
      std::fabs(minutes - std::round(minutes)) > 1e-6) {
    return fail(ErrorCode::kUsage, std::string(what) + " " + std::string(text) + ": no time zone",
                "hours from UTC, from -14 to 14, such as -7, 5.5 or +05:30");
  }
  return Minutes(static_cast<long>(std::round(minutes)));
}

}  // namespace gnomon::suns
