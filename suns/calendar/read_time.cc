// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/calendar/read_time.h"

#include <array>
#include <optional>
#include <span>

namespace gnomon::suns {

namespace chrono = std::chrono;

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes a number of at most `most` digits from the front.
std::optional<int> take_number(std::string_view& text, std::size_t most) {
  std::size_t count = 0;
  int value = 0;
  while (count < most && count < text.size() && is_digit(text[count])) {
    value = 10 * value + (text[count++] - '0');
  }
  if (count == 0) return std::nullopt;
  text.remove_prefix(count);
  return value;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

/// Numbers of two digits at most with these characters between them.
bool take_numbers(std::string_view& text, std::string_view between, std::span<int> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && !take(text, between[i - 1])) return false;
    const auto number = take_number(text, 2);
    if (!number) return false;
    numbers[i] = *number;
  }
  return true;
}

tl::expected<CivilTime, WrongTime> at(chrono::year year, int month, int day, int hour, int minute,
                                      int second) {
  const chrono::year_month_day date = year / month / day;
  if (!date.ok()) {
    return tl::unexpected("is no day of the year " + std::to_string(static_cast<int>(year)));
  }
  const bool ends_day = hour == 24 && minute == 0 && second == 0;
  if ((hour > 23 && !ends_day) || minute > 59 || second > 59) {
    return tl::unexpected<WrongTime>("is no time");
  }
  return chrono::local_days(date) + chrono::hours(hour) + chrono::minutes(minute) +
         chrono::seconds(second);
}

}  // namespace

tl::expected<CivilTime, WrongTime> read_end_of_step(std::string_view text, chrono::year year) {
  std::array<int, 2> date{}, clock{};
  bool is_time = take_numbers(text, "/", date) && take(text, ' ');
  while (take(text, ' ')) {
  }
  is_time = is_time && take_numbers(text, ":", clock);
  if (is_time && text == ":00") text = {};
  if (!is_time || !text.empty()) return tl::unexpected<WrongTime>("is no time");
  return at(year, date[0], date[1], clock[0], clock[1], 0);
}

tl::expected<ZonedTime, WrongTime> read_iso(std::string_view text) {
  std::array<int, 2> date{};
  std::array<int, 3> clock{};
  const auto year = take_number(text, 4);
  if (!year || !take(text, '-') || !take_numbers(text, "-", date) || !take(text, 'T') ||
      !take_numbers(text, "::", clock)) {
    return tl::unexpected<WrongTime>("is no time");
  }
  const auto zone = parse_zone(text, "");
  if (text.size() < 2 || !zone) return tl::unexpected<WrongTime>("has no zone");
  const auto time = at(chrono::year(*year), date[0], date[1], clock[0], clock[1], clock[2]);
  if (!time) return tl::unexpected(time.error());
  return ZonedTime{*time, *zone};
}

}  // namespace gnomon::suns
