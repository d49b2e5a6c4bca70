// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/scene_options.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/heap.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "gnomon/scene/light_arguments.h"
#include "gnomon/scene/read.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

constexpr std::size_t kExamples = 3;

void print_warnings(const std::string& file, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) warn(file + ": " + warning);
}

/// One line for each reason.
void warn_of_dropped(const LoadedScene& loaded) {
  std::map<std::string, std::vector<std::uint32_t>> dropped;
  for (const PreparationNote& note : loaded.prepared.notes) {
    if (note.repair == Repair::kZeroArea) dropped[note.detail].push_back(note.polygon);
  }
  for (const auto& [reason, polygons] : dropped) {
    std::string ids;
    for (std::size_t i = 0; i < polygons.size() && i < kExamples; ++i) {
      ids += (i == 0 ? "" : ", ") + loaded.scene.polygons[polygons[i]].id;
    }
    if (polygons.size() > kExamples) ids += ", ...";
    const std::string what =
        polygons.size() == 1
            ? "polygon " + ids + " is dropped: " + reason
            : report::grouped(polygons.size()) + " polygons are dropped (" + ids + "): " + reason;
    warn(loaded.scene.file + ": " + what);
  }
}

std::string listed_ids(const Scene& scene) {
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

}  // namespace

void add_numbers_option(CLI::App& command, std::string& numbers) {
  command
      .add_option("--numbers", numbers,
                  "What the numbers of the file mean: the nearest double, or the decimal itself")
      ->check(CLI::IsMember({"double", "decimal"}))
      ->type_name("double|decimal");
}

CLI::Option* add_scene_options(CLI::App& command, SceneOptions& options) {
  CLI::Option* scene = command.add_option(
      "SCENE", options.scene, "Scene file: " + shown_scene_extensions() + "; - reads JSON");
  scene->required()->type_name("FILE");
  add_numbers_option(command, options.numbers);
  repeatable(command.add_option("--point", options.points, "Add a point light x,y,z (repeatable)"))
      ->type_name("x,y,z");
  repeatable(command.add_option("--sun", options.suns,
                                "Add a directional light; x,y,z points to it (repeatable)"))
      ->type_name("x,y,z");
  repeatable(command.add_option("--area", options.areas, "Add an area light (repeatable)"))
      ->type_name("x,y,z:x,y,z:...");
  command
      .add_option("--lights", options.lights_file,
                  "Add the lights of a file that holds only lights")
      ->type_name("FILE");
  repeatable(
      command.add_option("--light", options.lights, "Only the light with this id (repeatable)"))
      ->type_name("ID");
  add_jobs_option(command, options.jobs);
  return scene;
}

std::optional<NumberMeaning> numbers_asked(const std::string& numbers) {
  if (numbers == "double") return NumberMeaning::kDouble;
  if (numbers == "decimal") return NumberMeaning::kDecimal;
  return std::nullopt;
}

Expected<Scene> read_scene_with_lights(const SceneOptions& options) {
  prefer_a_heap_in_large_pages();
  ReadOptions read_options;
  read_options.numbers = numbers_asked(options.numbers);
  auto read = read_scene(options.scene, read_options);
  if (!read) return tl::unexpected(read.error());
  print_warnings(read->scene.file, read->warnings);
  Scene scene = std::move(read->scene);
  if (!options.lights_file.empty()) {
    ReadOptions light_options;
    light_options.numbers = scene.numbers;
    light_options.lights_only = true;
    auto lights = read_scene(options.lights_file, light_options);
    if (!lights) return tl::unexpected(lights.error());
    print_warnings(lights->scene.file, lights->warnings);
    if (auto added = add_lights(scene, std::move(lights->scene.lights)); !added) {
      return tl::unexpected(added.error());
    }
  }
  auto lights = lights_from_arguments({options.points, options.suns, options.areas}, scene.numbers);
  if (!lights) return tl::unexpected(lights.error());
  if (auto added = add_lights(scene, std::move(*lights)); !added) {
    return tl::unexpected(added.error());
  }
  return scene;
}

Expected<LoadedScene> load_scene(const SceneOptions& options, bool needs_light) {
  LoadedScene loaded;
  Stopwatch stopwatch;
  auto scene = read_scene_with_lights(options);
  if (!scene) return tl::unexpected(scene.error());
  loaded.scene = std::move(*scene);
  loaded.reading = stopwatch.lap();
  auto prepared = prepare(loaded.scene);
  if (!prepared) return tl::unexpected(prepared.error());
  loaded.prepared = std::move(*prepared);
  loaded.preparation = stopwatch.lap();
  if (interrupted()) return fail(ErrorCode::kInterrupted, "interrupted");
  warn_of_dropped(loaded);

  const std::vector<Light>& lights = loaded.scene.lights;
  for (const std::string& id : options.lights) {
    const auto light = std::ranges::find(lights, id, &Light::id);
    if (light == lights.end()) {
      return fail(ErrorCode::kUsage, "--light " + id + ": no such light", listed_ids(loaded.scene));
    }
  }
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const bool asked = options.lights.empty() ||
                       std::ranges::find(options.lights, lights[i].id) != options.lights.end();
    if (asked) loaded.lights.push_back(i);
  }
  if (needs_light && loaded.lights.empty()) {
    return fail(ErrorCode::kUsage, loaded.scene.file + ": there is no light",
                "one in the scene, or --point=x,y,z, --sun=x,y,z or --area=x,y,z:x,y,z:...");
  }
  return loaded;
}

}  // namespace gnomon::cli
