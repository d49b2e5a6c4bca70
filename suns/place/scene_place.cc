// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/place/scene_place.h"

#include <rapidjson/document.h>

#include <cmath>

namespace gnomon::suns {

namespace {

const rapidjson::Value* member(const rapidjson::Value& object, const char* name) {
  if (!object.IsObject()) return nullptr;
  const auto found = object.FindMember(name);
  return found == object.MemberEnd() ? nullptr : &found->value;
}

double number(const rapidjson::Value& object, const char* name) {
  const rapidjson::Value* value = member(object, name);
  return value != nullptr && value->IsNumber() ? value->GetDouble() : 0;
}

}  // namespace

ScenePlace place_of_scene(const Scene& scene) {
  ScenePlace result;
  rapidjson::Document extra;
  extra.Parse<rapidjson::kParseFullPrecisionFlag>(scene.extra.data(), scene.extra.size());
  if (extra.HasParseError()) return result;
  const rapidjson::Value* model = member(extra, "energyplus");
  if (model == nullptr) return result;
  const rapidjson::Value* coordinates = member(*model, "coordinates");
  const rapidjson::Value* turned = member(*model, "turned");
  const bool is_relative = coordinates != nullptr && coordinates->IsString() &&
                           std::string_view(coordinates->GetString()) == "relative";
  if (is_relative && turned != nullptr && turned->IsFalse()) {
    result.north = number(*model, "north_axis");
  }
  if (const rapidjson::Value* location = member(*model, "location"); location != nullptr) {
    Place place;
    if (const rapidjson::Value* name = member(*location, "name"); name && name->IsString()) {
      place.name = name->GetString();
    }
    place.latitude = number(*location, "latitude");
    place.longitude = number(*location, "longitude");
    place.elevation = number(*location, "elevation");
    const double minutes = std::round(60 * number(*location, "time_zone"));
    if (std::fabs(minutes) <= 14 * 60 && check_place(place, "location")) {
      place.zone = std::chrono::minutes(static_cast<long>(minutes));
      result.place = place;
    }
  }
  return result;
}

}  // namespace gnomon::suns
