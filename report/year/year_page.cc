// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/year/year_page.h"

#include <fmt/format.h>

#include <cmath>

#include "report/json/json_writer.h"
#include "report/text/base64.h"

namespace gnomon::report {

namespace {

constexpr double kUnits = 10'000;

void write_months(JsonWriter& json, const std::vector<double>& months) {
  json.begin_array(JsonLayout::kInline);
  for (const double hours : months) json.value(hours);
  json.end_array();
}

}  // namespace

YearPage::YearPage(const YearHead& head, std::size_t most_shares)
    : head_(&head),
      has_shares_(head.rows * head.sides.size() <= most_shares),
      hours_(head.sides, head.suns.step) {}

void YearPage::add(const suns::SunTime& sun, std::span<const double> lit) {
  ++rows_;
  hours_.add(sun, lit);
  for (const std::int32_t component : sun.direction) suns_.push_back(sun.is_day ? component : 0);
  if (!has_shares_) return;
  for (const double share : lit) {
    lit_.push_back(static_cast<std::uint16_t>(std::lround(share * kUnits)));
  }
}

void YearPage::write(TextSink& sink) const {
  JsonWriter json(sink);
  const suns::YearOptions& suns = head_->suns;
  const auto first = suns::date_of(suns::CivilTime(suns.first));
  json.begin_object();
  json.member("format", "gnomon-year");
  json.member("version", 1);
  json.member("scene", head_->scene);
  json.member("geometry", head_->geometry);
  json.member("kernel", head_->kernel);
  json.member("latitude", suns.place.latitude);
  json.member("longitude", suns.place.longitude);
  json.member("zone_minutes", suns.place.zone.count());
  json.member("first", fmt::format("{:04}-{:02}-{:02}", static_cast<int>(first.year()),
                                   static_cast<unsigned>(first.month()),
                                   static_cast<unsigned>(first.day())));
  json.member("step_minutes", suns.step.count());
  json.member("rows", rows_);
  json.key("sides");
  json.begin_array();
  for (const std::string& side : head_->sides) json.value(side);
  json.end_array();
  json.member("suns", base64_of(std::span<const std::int32_t>(suns_)));
  json.member("units", kUnits);
  if (has_shares_) {
    json.member("lit", base64_of(std::span<const std::uint16_t>(lit_)));
  } else {
    json.member("left_out", fmt::format("{} sides at {} times are more than a page holds",
                                        head_->sides.size(), head_->rows));
  }
  json.key("hours");
  json.begin_array();
  for (std::size_t side = 0; side < head_->sides.size(); ++side) {
    write_months(json, hours_.hours_of(side));
  }
  json.end_array();
  json.key("daylight");
  write_months(json, hours_.daylight());
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
