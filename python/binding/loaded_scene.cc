// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/binding/loaded_scene.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gnomon/scene/intent.h"
#include "gnomon/scene/light_arguments.h"
#include "gnomon/scene/prepare_control.h"
#include "gnomon/scene/validate.h"
#include "python/binding/run_options.h"
#include "report/facts/intent_text.h"
#include "report/facts/scene_warnings.h"
#include "report/text/number_text.h"

namespace gnomon::python {

namespace {

std::string pointer_to(const char* list, std::size_t index, std::size_t inner) {
  return "/" + std::string(list) + "/" + std::to_string(index) + "/" + std::to_string(inner);
}

/// `list`: what the error calls the array of points.
Expected<Position> position_from(const Points& points, std::size_t index, NumberMeaning meaning,
                                 const char* list) {
  Position position;
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = points(index, k);
    if (!std::isfinite(value)) {
      return fail(ErrorCode::kNumber, report::shortest(value) + " is no coordinate",
                  "finite numbers", ErrorPlace{{}, 0, 0, pointer_to(list, index, k)});
    }
    if (meaning == NumberMeaning::kDouble) {
      position[k] = Number(value);
      continue;
    }
    auto number = Number::parse(report::shortest(value), meaning);
    if (!number) return tl::unexpected(std::move(number.error()));
    position[k] = *std::move(number);
  }
  return position;
}

Expected<PreparedScene> prepare_by(const Scene& scene, unsigned jobs,
                                   const std::atomic<bool>& stop) {
  const PrepareControl control{&stop, {}};
  if (jobs == 0) return prepare(scene, control);
  tbb::task_arena arena(static_cast<int>(usable_jobs(jobs)));
  return arena.execute([&] { return prepare(scene, control); });
}

void warn_of_prepared(LoadedScene& loaded) {
  std::ranges::move(report::dropped_warnings(loaded.scene, loaded.prepared),
                    std::back_inserter(loaded.warnings));
  // As the command has it: what costs next to nothing.
  constexpr std::size_t kMostParts = 2'000;
  const Intent intent =
      find_intent(loaded.scene, loaded.prepared, {.near = 0, .most_parts = kMostParts});
  const std::string text = report::intent_warning(loaded.scene, intent);
  if (!text.empty()) loaded.warnings.push_back(loaded.scene.file + ": " + text);
}

/// Errors: kIndex, with the place.
Expected<std::vector<VertexId>> loop_from(const SceneArrays& arrays, std::size_t polygon) {
  const std::int64_t first = arrays.offsets(polygon), last = arrays.offsets(polygon + 1);
  const auto vertices = static_cast<std::int64_t>(arrays.vertices.shape(0));
  std::vector<VertexId> loop;
  for (std::int64_t i = first; i < last; ++i) {
    const std::int64_t index = arrays.indices(static_cast<std::size_t>(i));
    if (index < 0 || index >= vertices) {
      const std::string bound =
          vertices == 0 ? "a scene with vertices" : "0 to " + std::to_string(vertices - 1);
      return fail(ErrorCode::kIndex, "index " + std::to_string(index) + " is not that of a vertex",
                  bound,
                  ErrorPlace{{},
                             0,
                             0,
                             "/polygons/" + std::to_string(polygon) + "/loop/" +
                                 std::to_string(i - first)});
    }
    loop.push_back(static_cast<VertexId>(index));
  }
  return loop;
}

Expected<void> add_polygons(const SceneArrays& arrays, Scene& scene) {
  const std::size_t count = arrays.offsets.shape(0) - 1;
  scene.polygons.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Polygon& polygon = scene.polygons[i];
    polygon.id = arrays.ids.empty() ? std::to_string(i) : arrays.ids[i];
    polygon.casts = !arrays.casts || (*arrays.casts)(i);
    auto loop = loop_from(arrays, i);
    if (!loop) return tl::unexpected(std::move(loop.error()));
    polygon.loop = *std::move(loop);
  }
  return {};
}

Expected<std::vector<Light>> points_from(const Points& points, NumberMeaning meaning) {
  std::vector<Light> lights(points.shape(0));
  for (std::size_t i = 0; i < lights.size(); ++i) {
    auto position = position_from(points, i, meaning, "points");
    if (!position) return tl::unexpected(std::move(position.error()));
    lights[i].id = "point" + std::to_string(i);
    lights[i].position = *std::move(position);
  }
  return lights;
}

Expected<Light> area_from(const Points& loop, std::size_t index, NumberMeaning meaning) {
  Light light;
  light.id = "area" + std::to_string(index);
  light.type = LightType::kArea;
  for (std::size_t i = 0; i < loop.shape(0); ++i) {
    auto corner = position_from(loop, i, meaning, light.id.c_str());
    if (!corner) return tl::unexpected(std::move(corner.error()));
    light.loop.push_back(*std::move(corner));
  }
  return light;
}

/// In the order of the command line's.
Expected<std::vector<Light>> lights_from(const AskedLights& asked, NumberMeaning meaning) {
  std::vector<Light> lights;
  const auto add = [&](Expected<std::vector<Light>>&& more) -> Expected<void> {
    if (!more) return tl::unexpected(std::move(more.error()));
    std::ranges::move(*more, std::back_inserter(lights));
    return {};
  };
  if (asked.points) {
    if (auto added = add(points_from(*asked.points, meaning)); !added) {
      return tl::unexpected(std::move(added.error()));
    }
  }
  if (asked.suns) {
    if (auto added = add(suns_from(*asked.suns, meaning)); !added) {
      return tl::unexpected(std::move(added.error()));
    }
  }
  for (std::size_t i = 0; i < asked.areas.size(); ++i) {
    auto light = area_from(asked.areas[i], i, meaning);
    if (!light) return tl::unexpected(std::move(light.error()));
    lights.push_back(*std::move(light));
  }
  return lights;
}

Expected<std::vector<std::uint32_t>> lights_named(const Scene& scene, const AskedLights& asked) {
  std::vector<std::uint32_t> chosen;
  if (!asked.ids && !asked.brings_any()) {
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) chosen.push_back(i);
    return chosen;
  }
  std::string known;
  for (const Light& light : scene.lights) known += (known.empty() ? "one of: " : ", ") + light.id;
  for (const std::string& id : asked.ids.value_or(std::vector<std::string>())) {
    const auto light = std::ranges::find(scene.lights, id, &Light::id);
    if (light == scene.lights.end()) {
      return fail(ErrorCode::kUsage, "--light " + id + ": no such light",
                  known.empty() ? "a light in the scene: there is none" : known);
    }
    chosen.push_back(static_cast<std::uint32_t>(light - scene.lights.begin()));
  }
  return chosen;
}

}  // namespace

Expected<LoadedScenePtr> read(const std::string& path, const ReadOptions& options, bool two_sided,
                              const std::atomic<bool>& stop) {
  auto file = read_scene(path, options);
  if (!file) return tl::unexpected(std::move(file.error()));
  auto loaded = std::make_shared<LoadedScene>();
  for (const std::string& warning : file->warnings) {
    loaded->warnings.push_back(file->scene.file + ": " + warning);
  }
  if (!file->left_out.empty()) loaded->warnings.push_back(report::left_out_warning(*file));
  for (const LeftOutPolygon& polygon : file->left_out) {
    loaded->left_out.emplace_back(polygon.id, to_string(polygon.why));
  }
  loaded->scene = std::move(file->scene);
  if (two_sided) {
    loaded->scene.two_sided = true;
    for (Polygon& polygon : loaded->scene.polygons) polygon.two_sided.reset();
  }
  auto prepared = prepare_by(loaded->scene, 0, stop);
  if (!prepared) {
    return tl::unexpected(with_line_of_polygon(std::move(prepared.error()), path, options));
  }
  loaded->prepared = *std::move(prepared);
  warn_of_prepared(*loaded);
  return loaded;
}

Expected<LoadedScenePtr> scene_from(const SceneArrays& arrays, const std::atomic<bool>& stop) {
  auto loaded = std::make_shared<LoadedScene>();
  Scene& scene = loaded->scene;
  auto meaning = meaning_of(arrays.numbers, NumberMeaning::kDouble);
  if (!meaning) return tl::unexpected(std::move(meaning.error()));
  scene.numbers = *meaning;
  scene.name = scene.file = arrays.name;
  scene.two_sided = arrays.two_sided;
  const auto placed = [&](Error error) {
    if (error.where.file.empty()) error.where.file = scene.file;
    return tl::unexpected(std::move(error));
  };
  scene.vertices.reserve(arrays.vertices.shape(0));
  for (std::size_t i = 0; i < arrays.vertices.shape(0); ++i) {
    auto position = position_from(arrays.vertices, i, scene.numbers, "vertices");
    if (!position) return placed(std::move(position.error()));
    scene.vertices.push_back(*std::move(position));
  }
  if (auto added = add_polygons(arrays, scene); !added) return placed(std::move(added.error()));
  if (auto valid = validate_scene(scene); !valid) return placed(std::move(valid.error()));
  auto prepared = prepare_by(scene, 0, stop);
  if (!prepared) return placed(std::move(prepared.error()));
  loaded->prepared = *std::move(prepared);
  warn_of_prepared(*loaded);
  return loaded;
}

Expected<LoadedScenePtr> under_lights(const LoadedScene& loaded, std::vector<Light> lights,
                                      unsigned jobs, const std::atomic<bool>& stop) {
  auto result = std::make_shared<LoadedScene>();
  result->scene = loaded.scene;
  result->scene.lights = std::move(lights);
  if (auto valid = validate_lights(result->scene); !valid) {
    return tl::unexpected(std::move(valid.error()));
  }
  auto prepared = prepare_by(result->scene, jobs, stop);
  if (!prepared) return tl::unexpected(std::move(prepared.error()));
  result->prepared = *std::move(prepared);
  return result;
}

Expected<NumberMeaning> meaning_of(const std::string& numbers, NumberMeaning of_scene) {
  if (numbers.empty()) return of_scene;
  if (numbers == "double") return NumberMeaning::kDouble;
  if (numbers == "decimal") return NumberMeaning::kDecimal;
  return fail(ErrorCode::kUsage, "--numbers: " + numbers + " not in {double,decimal}");
}

Expected<std::vector<Light>> suns_from(const Points& vectors, NumberMeaning meaning) {
  std::vector<Light> lights(vectors.shape(0));
  for (std::size_t i = 0; i < lights.size(); ++i) {
    auto direction = position_from(vectors, i, meaning, "suns");
    if (!direction) return tl::unexpected(std::move(direction.error()));
    lights[i].id = "sun" + std::to_string(i);
    lights[i].type = LightType::kDirectional;
    lights[i].position = *std::move(direction);
  }
  return lights;
}

Expected<LightsOfCall> lights_of_call(const LoadedScenePtr& loaded, const AskedLights& asked,
                                      unsigned jobs, const std::atomic<bool>& stop) {
  auto chosen = lights_named(loaded->scene, asked);
  if (!chosen) return tl::unexpected(std::move(chosen.error()));
  LightsOfCall result{loaded, *std::move(chosen)};
  if (asked.brings_any()) {
    auto meaning = meaning_of(asked.numbers, loaded->scene.numbers);
    if (!meaning) return tl::unexpected(std::move(meaning.error()));
    auto brought = lights_from(asked, *meaning);
    if (!brought) return tl::unexpected(std::move(brought.error()));
    std::vector<Light> lights;
    for (const std::uint32_t light : result.lights) lights.push_back(loaded->scene.lights[light]);
    std::ranges::move(*brought, std::back_inserter(lights));
    auto lit = under_lights(*loaded, std::move(lights), jobs, stop);
    if (!lit) return tl::unexpected(std::move(lit.error()));
    result.scene = *std::move(lit);
    result.lights.clear();
    for (std::uint32_t i = 0; i < result.scene->scene.lights.size(); ++i) {
      result.lights.push_back(i);
    }
  }
  if (result.lights.empty()) {
    return fail(ErrorCode::kUsage, loaded->scene.file + ": there is no light",
                "one in the scene, or --point=x,y,z, --sun=x,y,z or --area=x,y,z:x,y,z:...");
  }
  return result;
}

}  // namespace gnomon::python
