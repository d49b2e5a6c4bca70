// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/year/asked_suns.h"

#include <chrono>
#include <utility>

#include "suns/place/epw.h"
#include "suns/place/scene_place.h"

namespace gnomon::suns {

namespace {

Expected<void> wrong(std::string what, std::string expected) {
  return fail(ErrorCode::kUsage, std::move(what), std::move(expected));
}

std::optional<SunAt> sun_at_by_name(std::string_view name) {
  if (name == "start") return SunAt::kStart;
  if (name == "middle") return SunAt::kMiddle;
  if (name == "end") return SunAt::kEnd;
  return std::nullopt;
}

Expected<Place> place_asked(const AskedSuns& asked, const ScenePlace& of_scene) {
  Place place;
  if (!asked.at.empty()) {
    auto typed = parse_place(asked.at, "--at");
    if (!typed) return typed;
    auto zone = parse_zone(asked.zone, "--tz");
    if (!zone) return tl::unexpected(std::move(zone.error()));
    place = *std::move(typed);
    place.zone = *zone;
  } else if (!asked.weather.empty()) {
    auto read = read_epw_place(asked.weather);
    if (!read) return read;
    place = *std::move(read);
  } else if (of_scene.place) {
    place = *of_scene.place;
  } else {
    return fail(ErrorCode::kUsage, "no place is known",
                "--at LAT,LON and --tz H, --epw FILE, or a scene that tells its own");
  }
  if (asked.elevation) place.elevation = *asked.elevation;
  if (auto checked = check_place(place, "the place"); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  return place;
}

}  // namespace

Expected<void> check_asked_suns(const AskedSuns& asked) {
  if (!asked.at.empty() && !asked.weather.empty()) {
    return wrong("--at and --epw are two places", "one of them");
  }
  if (asked.at.empty() != asked.zone.empty()) {
    return wrong(asked.at.empty() ? "--tz without a place" : "--at without a time zone",
                 "--at LAT,LON and --tz H together");
  }
  if (!sun_model_by_name(asked.sun_model)) {
    return wrong("--sun-model " + asked.sun_model + ": no such model", "erfa or energyplus");
  }
  if (!sun_at_by_name(asked.sun_at)) {
    return wrong("--sun-at " + asked.sun_at + ": no place in a step", "start, middle or end");
  }
  constexpr int kMostDays = 366, kFirstYear = 1961, kLastYear = 2500;
  if (asked.average_days < 1 || asked.average_days > kMostDays) {
    return wrong("--average-days " + std::to_string(asked.average_days), "1 to 366");
  }
  if (asked.average_days > 1 && asked.sun_model != "energyplus") {
    return wrong("--average-days is of EnergyPlus' sun", "--sun-model energyplus too");
  }
  if (asked.year < kFirstYear || asked.year > kLastYear) {
    return wrong("--year " + std::to_string(asked.year), "1961 to 2500");
  }
  if (!asked.refraction && (asked.pressure || asked.temperature)) {
    return wrong("--pressure and --temperature are those of --refraction", "--refraction too");
  }
  return {};
}

Expected<YearOptions> suns_asked(const AskedSuns& asked, const Scene& scene) {
  const ScenePlace of_scene = place_of_scene(scene);
  auto place = place_asked(asked, of_scene);
  if (!place) return tl::unexpected(std::move(place.error()));
  YearOptions result;
  result.place = *std::move(place);
  const std::chrono::year year(asked.year);
  const auto day = [&](const std::string& text, const char* option, auto otherwise) {
    if (text.empty()) return Expected<std::chrono::local_days>(std::chrono::local_days(otherwise));
    return parse_day(text, year, option);
  };
  auto first = day(asked.from, "--from", year / std::chrono::January / 1);
  if (!first) return tl::unexpected(std::move(first.error()));
  auto last = day(asked.to, "--to", year / std::chrono::December / 31);
  if (!last) return tl::unexpected(std::move(last.error()));
  result.first = *first;
  result.last = *last;
  result.step = Minutes(asked.step);
  result.sun_at = sun_at_by_name(asked.sun_at).value();
  result.model = sun_model_by_name(asked.sun_model).value();
  result.average_days = asked.average_days;
  result.refraction = asked.refraction;
  result.air.pressure = asked.pressure.value_or(standard_pressure(result.place.elevation));
  result.air.temperature = asked.temperature.value_or(result.air.temperature);
  result.north = asked.north.value_or(of_scene.north);
  return result;
}

}  // namespace gnomon::suns
