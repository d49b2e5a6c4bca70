// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/light_places.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "gnomon/scene/light_arguments.h"

namespace gnomon::cli {

namespace {

/// Puts this option's name in the place of the one that parse_light_argument() knows.
Error named(Error error, const std::string& option) {
  const std::size_t colon = error.what.find(':');
  error.what = option + (colon == std::string::npos ? ": " + error.what : error.what.substr(colon));
  return error;
}

}  // namespace

std::string light_ids_text(const Scene& scene) {
  constexpr std::size_t kMost = 8;
  if (scene.lights.empty()) return "a light in the scene, --point, --sun or --area: there is none";
  std::string text = "one of: ";
  for (std::size_t i = 0; i < scene.lights.size() && i < kMost; ++i) {
    if (i > 0) text += ", ";
    text += scene.lights[i].id;
  }
  if (scene.lights.size() > kMost) text += ", ...";
  return text;
}

Expected<LightPlaces> parse_light_places(std::string_view option, std::string_view text,
                                         const Scene& scene) {
  // An id may hold any character, a place has no '='.
  const std::size_t equals = text.rfind('=');
  if (equals == std::string_view::npos) {
    return fail(ErrorCode::kUsage,
                std::string(option) + " " + std::string(text) + ": there is no '='",
                "LIGHT=x,y,z, LIGHT the id of a light");
  }
  const std::string id(text.substr(0, equals));
  const std::string here = std::string(option) + " " + id;
  const auto light = std::ranges::find(scene.lights, id, &Light::id);
  if (light == scene.lights.end()) {
    return fail(ErrorCode::kUsage, here + ": no such light", light_ids_text(scene));
  }
  if (light->has_area()) {
    return fail(ErrorCode::kUsage, here + ": it is an area light", "a point or directional light");
  }
  LightPlaces result{static_cast<std::uint32_t>(light - scene.lights.begin()), {}};
  for (std::string_view rest = text.substr(equals + 1);;) {
    const std::size_t colon = rest.find(':');
    auto place = parse_light_argument(light->type, rest.substr(0, colon), scene.numbers, id);
    if (!place) return tl::unexpected(named(std::move(place.error()), here));
    place->intensity = light->intensity;
    result.places.push_back(*std::move(place));
    if (colon == std::string_view::npos) return result;
    rest.remove_prefix(colon + 1);
  }
}

}  // namespace gnomon::cli
