// SPDX-License-Identifier: GPL-3.0-or-later
// Places of lights that a scene has already: LIGHT=x,y,z[:x,y,z...] on the command line.
#ifndef GNOMON_CLI_COMMON_LIGHT_PLACES_H
#define GNOMON_CLI_COMMON_LIGHT_PLACES_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon::cli {

/// A light of a scene, and the same light at each of the places; of a directional light they are
/// directions to it.
struct LightPlaces {
  std::uint32_t light = 0;  // index into Scene::lights
  std::vector<Light> places;
};

/// `option` is named in errors. Errors: kUsage (no such light, an area light, no place), and those
/// of parse_light_argument().
Expected<LightPlaces> parse_light_places(std::string_view option, std::string_view text,
                                         const Scene& scene);

/// The ids of the scene's lights as what was expected.
std::string light_ids_text(const Scene& scene);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_LIGHT_PLACES_H
