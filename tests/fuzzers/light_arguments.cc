// SPDX-License-Identifier: GPL-3.0-or-later
// The texts behind --point, --sun and --area. The first byte says which (p, s, a), the rest is the
// text.
#include "gnomon/scene/light_arguments.h"

#include "gnomon/scene/validate.h"
#include "harness.h"

namespace {

using namespace gnomon;
using namespace gnomon::fuzzers;

void check_light(LightType type, std::string_view text) {
  for (const NumberMeaning meaning : {NumberMeaning::kDouble, NumberMeaning::kDecimal}) {
    Scene scene;
    scene.numbers = meaning;
    auto light = parse_light_argument(type, text, meaning, "light0");
    if (!light) {
      check_error(light.error(), light.error().where.file, {}, false);
      continue;
    }
    require(light->type == type, "another type");
    require(add_lights(scene, {*light}).has_value(), "the light cannot be added");
    require(validate_lights(scene).has_value(), "an invalid light");
    require(!add_lights(scene, {*light}).has_value(), "one id twice");
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text = text_of(data + 1, size - 1);
  check_light(data[0] == 'p'   ? LightType::kPoint
              : data[0] == 's' ? LightType::kDirectional
                               : LightType::kArea,
              text);
  return 0;
}
