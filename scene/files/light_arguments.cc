// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/light_arguments.h"

#include <algorithm>
#include <iterator>

#include "gnomon/scene/validate.h"
#include "scene/base/text_file.h"

namespace gnomon {

namespace {

const char* option_name(LightType type) {
  switch (type) {
    case LightType::kPoint:
      return "--point";
    case LightType::kDirectional:
      return "--sun";
    case LightType::kArea:
      return "--area";
  }
  return "";
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Takes what stands before the separator off the text; all of it if there is none.
std::string_view take_until(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

Expected<Position> parse_position(std::string_view text, NumberMeaning meaning,
                                  const std::string& option) {
  const std::string_view whole = text;
  if (std::count(text.begin(), text.end(), ',') != 2) {
    return fail(ErrorCode::kUsage, option + ": " + quoted_text(whole) + " is not a point", "x,y,z");
  }
  Position position;
  for (Number& coordinate : position) {
    auto number = Number::parse(trimmed(take_until(text, ',')), meaning);
    if (!number) {
      number.error().what = option + ": " + number.error().what;
      return tl::unexpected(std::move(number.error()));
    }
    coordinate = *std::move(number);
  }
  return position;
}

}  // namespace

Expected<Light> parse_light_argument(LightType type, std::string_view text, NumberMeaning meaning,
                                     std::string id) {
  const std::string option = option_name(type);
  Light light;
  light.id = std::move(id);
  light.type = type;
  if (type == LightType::kArea) {
    const auto count = std::count(text.begin(), text.end(), ':') + 1;
    if (count < 3) {
      return fail(ErrorCode::kUsage, option + ": fewer than three points", "x,y,z:x,y,z:x,y,z");
    }
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      auto point = parse_position(take_until(text, ':'), meaning, option);
      if (!point) return tl::unexpected(std::move(point.error()));
      light.loop.push_back(*std::move(point));
    }
    return light;
  }
  auto position = parse_position(text, meaning, option);
  if (!position) return tl::unexpected(std::move(position.error()));
  light.position = *std::move(position);
  const bool is_zero = std::all_of(light.position.begin(), light.position.end(),
                                   [](const Number& number) { return number.is_zero(); });
  if (type == LightType::kDirectional && is_zero) {
    return fail(ErrorCode::kGeometry, option + ": the direction to the light is (0, 0, 0)",
                "a vector that is not 0");
  }
  return light;
}

Expected<std::vector<Light>> lights_from_arguments(const LightArguments& arguments,
                                                   NumberMeaning meaning) {
  struct Kind {
    LightType type;
    const std::vector<std::string>& texts;
    const char* prefix;
  };
  const Kind kinds[] = {{LightType::kPoint, arguments.points, "point"},
                        {LightType::kDirectional, arguments.suns, "sun"},
                        {LightType::kArea, arguments.areas, "area"}};
  std::vector<Light> lights;
  for (const Kind& kind : kinds) {
    for (std::size_t i = 0; i < kind.texts.size(); ++i) {
      auto light =
          parse_light_argument(kind.type, kind.texts[i], meaning, kind.prefix + std::to_string(i));
      if (!light) return tl::unexpected(std::move(light.error()));
      lights.push_back(*std::move(light));
    }
  }
  return lights;
}

Expected<void> add_lights(Scene& scene, std::vector<Light> lights) {
  scene.lights.insert(scene.lights.end(), std::make_move_iterator(lights.begin()),
                      std::make_move_iterator(lights.end()));
  return validate_lights(scene);
}

}  // namespace gnomon
