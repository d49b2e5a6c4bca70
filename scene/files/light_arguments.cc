// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/light_arguments.h"

#include <algorithm>
#include <iterator>

#include "gnomon/scene/validate.h"
#include "scene/base/text_file.h"
#include "scene/files/argument_parts.h"

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
