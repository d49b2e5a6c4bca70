// SPDX-License-Identifier: LGPL-3.0-or-later
// What a reader of energy models says at the end: groups, place and north in the scene's "extra";
// one line for each thing that is not as the file has it.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/energyplus/energy_scene.h"
#include "scene/files/left_out.h"
#include "scene/files/readers.h"
#include "scene/files/scene_builder.h"
#include "scene/files/usable_id.h"

namespace gnomon::energy {

/// {"groups": {zone or kind: ids}, "energyplus": {"version", "coordinates", "north_axis", "turned",
/// "kinds": [names of groups], "location": {...}}}.
std::string EnergyScene::extra() const {
  std::vector<ExtraFact> facts = {
      {"coordinates", json_string(rules_.is_world ? "world" : "relative")},
      {"north_axis", north_.to_text()},
      {"turned", is_turned_ ? "true" : "false"},
      {"kinds", json_array(kind_names(zone_groups_.list(), kind_groups_.list()))}};
  for (const EnergyObject& object : model_.objects) {
    if (object.type->kind == EnergyKind::kVersion) {
      facts.emplace_back("version",
                         json_string(usable_text(object.field("version_identifier").text)));
    }
    if (object.type->kind != EnergyKind::kLocation) continue;
    std::vector<ExtraFact> location = {{"name", json_string(usable_text(object.name()))}};
    for (const char* field : {"latitude", "longitude", "time_zone", "elevation"}) {
      const auto number = model_.number(object, field, "0");
      if (number) location.emplace_back(field, number->to_text());
    }
    facts.emplace_back("location", json_object(location));
    break;
  }
  return extra_with_groups(scene_, zone_groups_.list(), kind_groups_.list(), "energyplus", facts);
}

void EnergyScene::warn_of_turns(std::vector<std::string>& warnings) const {
  const auto told = [&](const std::string& what, const Number& north, const Angle& angle) {
    warnings.push_back(fmt::format(
        "{} by {} degrees with a cosine and a sine of 12 digits: {:.1g} degrees off, horizontal "
        "lengths by {:.1g} of themselves",
        what, north.to_text(), angle.error, std::abs(angle.stretch)));
  };
  if (rules_.is_world) {
    if (!north_.is_zero()) {
      warnings.push_back("the building's north axis of " + north_.to_text() +
                         " degrees counts for nothing where coordinates are those of the world");
    }
    return;
  }
  if (!is_turned_ && !north_.is_zero()) {
    warnings.push_back("the building stays in its own axes, whose north is turned by " +
                       north_.to_text() + " degrees: the sun has to be turned");
  } else if (building_angle_.is_rounded) {
    told("the building is turned", north_, building_angle_);
  } else if (options_.keep_axes && !north_.is_zero()) {
    warnings.push_back("the building is turned by " + north_.to_text() +
                       " degrees, since shading of the site is not turned with it");
  }
  std::size_t zones = 0;
  const Zone* example = nullptr;
  const Angle* angle = nullptr;
  for (const auto& [name, zone] : zones_) {
    const Angle& own = zone_angles_.at(name);
    if (!own.is_rounded) continue;
    ++zones;
    if (angle == nullptr || own.error > angle->error) {
      example = &zone;
      angle = &own;
    }
  }
  if (zones != 0) {
    told(counted_as(zones, "zone is turned", "zones are turned, the worst"), example->north,
         *angle);
  }
}

void EnergyScene::warn(std::vector<std::string>& warnings) const {
  if (interior_ != 0) {
    warnings.push_back(counted_as(interior_, "interior surface", "interior surfaces") +
                       " left out: what does not face the outdoors neither casts nor receives");
  }
  if (!schedules_.empty()) {
    std::size_t shades = 0;
    std::string names;
    for (const auto& [name, count] : schedules_) {
      shades += count;
      names += (names.empty() ? "" : ", ") + name;
    }
    warnings.push_back(counted_as(shades, "shading surface", "shading surfaces") +
                       " with a transmittance schedule (" + names + ") " +
                       (shades == 1 ? "counts" : "count") + " as opaque");
  }
  warn_of_turns(warnings);
  if (!rounded_.empty()) {
    constexpr std::size_t kExamples = 3;
    std::string ids;
    for (std::size_t i = 0; i < std::min(rounded_.size(), kExamples); ++i) {
      ids += (i == 0 ? "" : ", ") + rounded_[i];
    }
    if (rounded_.size() > kExamples) ids += ", ...";
    warnings.push_back(counted_as(rounded_.size(), "surface is", "surfaces are") +
                       " placed by lengths along a wall or by angles that no decimals are, "
                       "rounded at the 12th digit or later (" +
                       ids + ")");
  }
  if (turned_openings_ != 0) {
    warnings.push_back(
        counted_as(turned_openings_, "window or door looks", "windows and doors look") +
        " the other way than the wall: turned over");
  }
  if (unexposed_ != 0) {
    warnings.push_back(counted_as(unexposed_, "outer surface is", "outer surfaces are") +
                       " said not to be exposed to the sun: kept");
  }
  if (multiplied_ != 0) {
    warnings.push_back(counted_as(multiplied_, "window has", "windows have") +
                       " a multiplier: each is there once");
  }
  if (underflows_ != 0) {
    warnings.push_back(counted_as(underflows_, "coordinate is", "coordinates are") +
                       " too small for full double precision");
  }
  for (const EnergyObject& object : model_.objects) {
    if (object.type->kind == EnergyKind::kNoted) {
      warnings.push_back("frames, dividers and reveals of windows (" +
                         std::string(object.type->name) + ") are no part of the scene");
      break;
    }
  }
  for (const EnergyObject& object : model_.objects) {
    if (object.type->kind == EnergyKind::kBuilding &&
        same_word(object.field("solar_distribution").text, "MinimalShadowing")) {
      warnings.emplace_back(
          "the file asks for MinimalShadowing, with which EnergyPlus computes no shadows");
    }
  }
}

void EnergyScene::finish(ReadResult& result) {
  scene_.extra = extra();
  warn(result.warnings);
  if (!options_.skip_bad && !options_.polygon_offsets) offsets_.clear();
  result.scene = std::move(scene_);
  result.polygon_offsets = std::move(offsets_);
  leave_out(result, std::move(problems_));
  if (result.scene.polygons.empty()) result.warnings.emplace_back("the scene has no polygons");
}

}  // namespace gnomon::energy
