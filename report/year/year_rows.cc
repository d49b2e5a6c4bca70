// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/year/year_rows.h"

#include <map>
#include <utility>

namespace gnomon::report {

SunsOfRows::SunsOfRows(std::span<const suns::SunTime> times, std::vector<std::size_t> wanted,
                       suns::Minutes zone)
    : rows(std::move(wanted)) {
  std::map<suns::Direction, std::uint32_t> known;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const suns::SunTime& sun = times[rows[i]];
    if (!sun.is_day) {
      light.push_back(kNight);
      continue;
    }
    const auto [place, is_new] =
        known.emplace(sun.direction, static_cast<std::uint32_t>(lights.size()));
    if (is_new) {
      lights.push_back(suns::light_of(sun, zone));
      last_use.push_back(i);
    }
    light.push_back(place->second);
    last_use[place->second] = i;
  }
}

bool YearRows::advance() {
  while (!stopped_ && next_ < suns_->rows.size()) {
    const std::uint32_t light = suns_->light[next_];
    const auto kept = kept_.find(light);
    if (light != SunsOfRows::kNight && kept == kept_.end()) break;
    const std::vector<double>& lit = light == SunsOfRows::kNight ? night_ : kept->second;
    stopped_ = !take_(suns_->rows[next_], lit);
    if (kept != kept_.end() && suns_->last_use[light] == next_) kept_.erase(kept);
    if (!stopped_) ++next_;
  }
  return !stopped_;
}

bool YearRows::add(const LightResult& light) {
  std::vector<double> lit(columns_->size());
  columns_->read_lit(light, lit);
  kept_.emplace(light.light, std::move(lit));
  return advance();
}

}  // namespace gnomon::report
