// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/scene_options.h"

#include <algorithm>
#include <string>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/heap.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/light_places.h"
#include "cli/common/messages.h"
#include "cli/common/progress.h"
#include "gnomon/scene/light_arguments.h"
#include "gnomon/scene/prepare_control.h"
#include "gnomon/scene/read.h"
#include "report/facts/intent_text.h"
#include "report/facts/scene_warnings.h"

namespace gnomon::cli {

namespace {

void print_warnings(const std::string& file, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) warn(file + ": " + warning);
}

}  // namespace

void add_numbers_option(CLI::App& command, std::string& numbers) {
  command
      .add_option("--numbers", numbers,
                  "What the numbers of the file mean: the nearest double, or the decimal itself")
      ->check(CLI::IsMember({"double", "decimal"}))
      ->type_name("double|decimal");
}

CLI::Option* add_scene_file_options(CLI::App& command, SceneOptions& options) {
  CLI::Option* scene = command.add_option(
      "SCENE", options.scene, "Scene file: " + shown_scene_extensions() + "; - reads JSON");
  scene->required()->type_name("FILE");
  add_numbers_option(command, options.numbers);
  command.add_flag("--two-sided", options.two_sided,
                   "Both sides of all polygons receive and cast, whatever the file says");
  command.add_flag("--skip-bad", options.skip_bad,
                   "Leave out polygons that cannot be used (they cross themselves, name no vertex\n"
                   "or too few, have a coordinate that is no number), and name them");
  command
      .add_option("--lod", options.lod,
                  "Of CityJSON: this level of detail alone, instead of each object's highest")
      ->type_name("L");
  command
      .add_option("--up-axis", options.up,
                  "Which axis of the file points upwards [of glTF y, of others z]; (x, y, z) of a\n"
                  "file with y up becomes (x, -z, y), exactly. Lights of options are in the axes "
                  "of the result")
      ->check(CLI::IsMember({"y", "z"}))
      ->type_name("y|z");
  add_jobs_option(command, options.jobs);
  return scene;
}

CLI::Option* add_scene_options(CLI::App& command, SceneOptions& options) {
  CLI::Option* scene = add_scene_file_options(command, options);
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
      command.add_option("--cone", options.cones,
                         "Point lights shine through this convex polygon alone (repeatable)"))
      ->type_name("x,y,z:x,y,z:...");
  repeatable(command.add_option("--flap", options.flaps,
                                "Point and directional lights shine between two heights alone, as "
                                "in z:0:3;\neither may be missing (repeatable)"))
      ->type_name("axis:low:high");
  repeatable(
      command.add_option("--light", options.lights, "Only the light with this id (repeatable)"))
      ->type_name("ID");
  return scene;
}

std::optional<NumberMeaning> numbers_asked(const std::string& numbers) {
  if (numbers == "double") return NumberMeaning::kDouble;
  if (numbers == "decimal") return NumberMeaning::kDecimal;
  return std::nullopt;
}

ReadOptions read_options(const SceneOptions& options) {
  ReadOptions result;
  result.numbers = numbers_asked(options.numbers);
  result.skip_bad = options.skip_bad;
  result.keep_axes = options.keep_axes;
  result.lod = options.lod;
  if (!options.up.empty()) result.up = options.up == "y" ? UpAxis::kY : UpAxis::kZ;
  return result;
}

Expected<SceneAsRead> read_scene_with_lights(const SceneOptions& options) {
  prefer_a_heap_in_large_pages();
  auto read = read_scene(options.scene, read_options(options));
  if (!read) return tl::unexpected(read.error());
  print_warnings(read->scene.file, read->warnings);
  if (!read->left_out.empty()) warn(report::left_out_warning(*read));
  SceneAsRead result{std::move(read->scene), std::move(read->left_out)};
  Scene& scene = result.scene;
  if (options.two_sided) {
    scene.two_sided = true;
    for (Polygon& polygon : scene.polygons) polygon.two_sided.reset();
  }
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
  return result;
}

Expected<LoadedScene> load_scene_under(const SceneOptions& options,
                                       const std::function<Expected<void>(Scene&)>& set_lights) {
  LoadedScene loaded;
  Stopwatch stopwatch;
  auto scene = read_scene_with_lights(options);
  if (!scene) return tl::unexpected(scene.error());
  loaded.scene = std::move(scene->scene);
  loaded.left_out = std::move(scene->left_out);
  if (auto set = set_lights(loaded.scene); !set) return tl::unexpected(std::move(set.error()));
  loaded.reading = stopwatch.lap();
  ProgressBar progress("preparing");
  auto prepared = prepare(loaded.scene, {&interrupted(), progress.callback()});
  progress.clear();
  if (!prepared) {
    if (interrupted()) return tl::unexpected(std::move(prepared.error()));
    return tl::unexpected(
        with_line_of_polygon(std::move(prepared.error()), options.scene, read_options(options)));
  }
  loaded.prepared = std::move(*prepared);
  loaded.preparation = stopwatch.lap();
  if (interrupted()) return fail(ErrorCode::kInterrupted, "interrupted");
  for (const std::string& warning : report::dropped_warnings(loaded.scene, loaded.prepared)) {
    warn(warning);
  }
  return loaded;
}

/// Adds the eye, and says where lights shine.
Expected<void> complete_lights(const SceneOptions& options, Scene& scene) {
  if (!options.eye.empty()) {
    auto position = parse_position(options.eye, scene.numbers, "--eye");
    if (!position) return tl::unexpected(std::move(position.error()));
    Light eye;
    eye.id = kEyeId;
    eye.position = *std::move(position);
    eye.is_eye = true;
    if (auto added = add_lights(scene, {std::move(eye)}); !added) return added;
  }
  return add_regions(scene, {options.cones, options.flaps});
}

Expected<void> choose_lights(const SceneOptions& options, LoadedScene& loaded, std::size_t count) {
  const std::vector<Light>& lights = loaded.scene.lights;
  for (const std::string& id : options.lights) {
    const auto light = std::ranges::find(lights, id, &Light::id);
    if (light == lights.end()) {
      return fail(ErrorCode::kUsage, "--light " + id + ": no such light",
                  light_ids_text(loaded.scene));
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool asked = options.lights.empty() || lights[i].is_eye ||
                       std::ranges::find(options.lights, lights[i].id) != options.lights.end();
    if (asked) loaded.lights.push_back(i);
  }
  return {};
}

Expected<LoadedScene> load_scene(const SceneOptions& options, bool needs_light) {
  auto read =
      load_scene_under(options, [&](Scene& scene) { return complete_lights(options, scene); });
  if (!read) return read;
  LoadedScene& loaded = *read;
  if (auto chosen = choose_lights(options, loaded, loaded.scene.lights.size()); !chosen) {
    return tl::unexpected(std::move(chosen.error()));
  }
  if (needs_light && loaded.lights.empty()) {
    return fail(ErrorCode::kUsage, loaded.scene.file + ": there is no light",
                "one in the scene, or --point=x,y,z, --sun=x,y,z or --area=x,y,z:x,y,z:...");
  }
  return read;
}

void choose_eye(LoadedScene& loaded) {
  loaded.lights = {static_cast<std::uint32_t>(loaded.scene.lights.size() - 1)};
}

void warn_of_intent(const LoadedScene& loaded) {
  // The diagnosis takes about as long as preparation does, and a large scene is read, prepared and
  // classified in less than ten times that.
  constexpr std::size_t kMostParts = 2'000;
  const Intent intent =
      find_intent(loaded.scene, loaded.prepared, {.near = 0, .most_parts = kMostParts});
  const std::string text = report::intent_warning(loaded.scene, intent);
  if (!text.empty()) warn(loaded.scene.file + ": " + text);
}

}  // namespace gnomon::cli
