// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/year/sun_hours.h"

#include <numeric>

#include "report/text/csv_field.h"
#include "report/text/number_text.h"

namespace gnomon::report {

void SunHours::add(const suns::SunTime& sun, std::span<const double> lit) {
  if (!sun.is_day) return;
  // The last step of a month ends in the next one.
  const auto month =
      static_cast<unsigned>(suns::date_of(sun.end - std::chrono::seconds(1)).month()) - 1;
  for (std::size_t i = 0; i < lit.size(); ++i) hours_[i][month] += lit[i];
  daylight_[month] += 1;
}

std::vector<double> SunHours::in_hours(const Months& months) const {
  std::vector<double> hours;
  for (const double steps : months) hours.push_back(hours_of_step() * steps);
  return hours;
}

std::string SunHours::text() const {
  std::string text = "side,all";
  for (int month = 1; month <= 12; ++month)
    text += (month < 10 ? ",0" : ",") + std::to_string(month);
  text += '\n';
  const auto append = [&](const std::string& name, const Months& months) {
    append_csv_field(text, name);
    text += ',' + rounded(hours_of_step() * std::accumulate(months.begin(), months.end(), 0.0), 9);
    for (const double steps : months) text += ',' + rounded(hours_of_step() * steps, 9);
    text += '\n';
  };
  for (std::size_t i = 0; i < sides_.size(); ++i) append(sides_[i], hours_[i]);
  append("daylight", daylight_);
  return text;
}

}  // namespace gnomon::report
