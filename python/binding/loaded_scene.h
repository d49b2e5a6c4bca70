// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as Python holds it: as it was read, and prepared, so that what is wrong with it is told
// when it is made. It never changes; other lights make another one.
#ifndef GNOMON_PYTHON_BINDING_LOADED_SCENE_H
#define GNOMON_PYTHON_BINDING_LOADED_SCENE_H

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/scene.h"
#include "python/binding/arrays.h"

namespace gnomon::python {

struct LoadedScene {
  Scene scene;
  std::vector<std::pair<std::string, std::string>> left_out;  // ids, and why
  PreparedScene prepared;
  std::vector<std::string> warnings;
};
using LoadedScenePtr = std::shared_ptr<const LoadedScene>;

/// Lights that a call brings along, besides those of the scene that it names.
struct AskedLights {
  std::optional<std::vector<std::string>> ids;  // of the scene; none: all, if the call brings none
  std::optional<Points> suns, points;
  std::vector<Points> areas;
  std::string numbers;  // what their numbers mean: "double", "decimal", or "" as the scene's

  bool brings_any() const { return suns || points || !areas.empty(); }
};

/// Errors: those of read_scene() and prepare(), with the line of the polygon.
Expected<LoadedScenePtr> read(const std::string& path, const ReadOptions& options, bool two_sided,
                              const std::atomic<bool>& stop);

/// Polygon i has the corners indices[offsets[i]] .. indices[offsets[i + 1] - 1]. Errors: kNumber,
/// kIndex, kId, kFormat, kGeometry, with the place as a JSON pointer.
struct SceneArrays {
  Points vertices;
  Integers indices, offsets;
  std::vector<std::string> ids;  // none: the indices
  std::optional<Flags> casts;
  bool two_sided = false;
  std::string numbers, name;
};
Expected<LoadedScenePtr> scene_from(const SceneArrays& arrays, const std::atomic<bool>& stop);

/// The same polygons under the suns that `set_lights` gives them.
Expected<LoadedScenePtr> under_lights(const LoadedScene& loaded, std::vector<Light> lights,
                                      unsigned jobs, const std::atomic<bool>& stop);

/// What "double", "decimal" or "" (as the scene's) mean. Errors: kUsage.
Expected<NumberMeaning> meaning_of(const std::string& numbers, NumberMeaning of_scene);

/// Directional lights sun0, sun1, ... Errors: kNumber, kGeometry, with the place.
Expected<std::vector<Light>> suns_from(const Points& vectors, NumberMeaning meaning);

/// The scene itself where the call brings no lights, and the indices of the lights asked for.
/// Errors: kUsage (no such light, no light at all); those of lights and of preparing them.
struct LightsOfCall {
  LoadedScenePtr scene;
  std::vector<std::uint32_t> lights;
};
Expected<LightsOfCall> lights_of_call(const LoadedScenePtr& loaded, const AskedLights& asked,
                                      unsigned jobs, const std::atomic<bool>& stop);

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_LOADED_SCENE_H
