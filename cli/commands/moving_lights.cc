// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/moving_lights.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/light_places.h"
#include "cli/common/output.h"
#include "cli/common/stopwatch.h"
#include "gnomon/algorithms/shadows.h"
#include "report/json/steps_json.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

constexpr std::string_view kStepNumber = "%d";

/// Reads all moves, and gives the scene a light for each place.
Expected<std::vector<LightPlaces>> add_places(const MoveOptions& options, Scene& scene) {
  std::vector<LightPlaces> moves;
  for (const std::string& text : options.moves) {
    auto move = parse_light_places("--move", text, scene);
    if (!move) return tl::unexpected(std::move(move.error()));
    const std::string& id = scene.lights[move->light].id;
    if (std::ranges::count(moves, move->light, &LightPlaces::light) > 0) {
      return fail(ErrorCode::kUsage, "--move " + id + ": it is moved twice",
                  "one --move for each light: " + id + "=x,y,z:x,y,z...");
    }
    moves.push_back(*std::move(move));
  }
  return moves;
}

/// Step by step, each light at its next place for as long as it has one.
std::vector<std::vector<std::uint32_t>> steps_of(const std::vector<std::uint32_t>& lights,
                                                 const std::vector<LightPlaces>& moves,
                                                 std::uint32_t first_place) {
  std::size_t most = 0;
  for (const LightPlaces& move : moves) most = std::max(most, move.places.size());
  std::vector<std::vector<std::uint32_t>> steps(most, lights);
  for (const LightPlaces& move : moves) {
    const auto slot =
        static_cast<std::size_t>(std::ranges::find(lights, move.light) - lights.begin());
    for (std::size_t step = 0; step < most; ++step) {
      const std::size_t place = std::min(step, move.places.size() - 1);
      steps[step][slot] = first_place + static_cast<std::uint32_t>(place);
    }
    first_place += static_cast<std::uint32_t>(move.places.size());
  }
  return steps;
}

/// The file of a step; none if all go into one.
std::optional<std::string> file_of_step(const std::string& output, std::size_t step) {
  const std::size_t at = output.find(kStepNumber);
  if (at == std::string::npos) return std::nullopt;
  std::string name = output;
  return name.replace(at, kStepNumber.size(), std::to_string(step));
}

std::string step_text(std::size_t step, const TogetherCounts& counts, const Seconds& seconds) {
  using report::grouped;
  return "step " + std::to_string(step) + ": " + grouped(counts.trees_built) + " of " +
         grouped(counts.trees) + " trees built, " + grouped(counts.filters) + " of " +
         grouped(counts.filters_from_nothing) + " loops filtered; " + grouped(counts.kept_bytes) +
         " bytes of fragments and " + grouped(counts.tree_bytes_at_once) +
         " of trees kept; CPU seconds (elapsed): " + report::rounded(seconds.cpu, 3) + " (" +
         report::rounded(seconds.elapsed, 3) + ")\n";
}

/// Writes one step after another.
class StepWriter {
 public:
  StepWriter(const MovingScene& scene, const report::ResultJsonOptions& json,
             const std::string& output)
      : scene_(scene), json_(json), output_(output) {}

  Expected<void> write(const ShadowResult& result) {
    const std::size_t step = step_++;
    if (const auto own = file_of_step(output_, step)) return write_own_file(*own, result);
    if (!all_) {
      auto file = Output::open(output_);
      if (!file) return tl::unexpected(std::move(file.error()));
      file_.emplace(*std::move(file));
      file_->give_up_if(interrupted());
      all_.emplace(*file_, scene_.loaded.scene, scene_.loaded.prepared, json_);
    }
    all_->add(result, moved_at(step));
    return {};
  }
  Expected<void> finish() {
    if (!all_) return {};
    all_->finish();
    all_.reset();
    return file_->finish();
  }

 private:
  Expected<void> write_own_file(const std::string& path, const ShadowResult& result) const {
    auto file = Output::open(path);
    if (!file) return tl::unexpected(std::move(file.error()));
    file->give_up_if(interrupted());
    report::write_result_json(*file, scene_.loaded.scene, scene_.loaded.prepared, result, json_);
    return file->finish();
  }
  /// Lights of a step that are not where the scene has them.
  std::vector<std::uint32_t> moved_at(std::size_t step) const {
    std::vector<std::uint32_t> moved;
    if (step == 0) return moved;
    const std::vector<std::uint32_t>& lights = scene_.steps[step - 1];
    for (std::size_t i = 0; i < lights.size(); ++i) {
      if (lights[i] != scene_.loaded.lights[i]) moved.push_back(lights[i]);
    }
    return moved;
  }

  const MovingScene& scene_;
  const report::ResultJsonOptions& json_;
  const std::string& output_;
  std::size_t step_ = 0;
  std::optional<Output> file_;
  std::optional<report::StepsJson> all_;
};

}  // namespace

void add_move_option(CLI::App& command, MoveOptions& options, CLI::Option* combined) {
  repeatable(
      command.add_option(
          "--move", options.moves,
          "With --combined: move a light to each of these places, and write the result of\n"
          "each step; of a sun they are directions to it (repeatable). Step 0 is the scene as\n"
          "it is. -o FILE with %d in its name: a file for each step"))
      ->needs(combined)
      ->type_name("LIGHT=x,y,z[:x,y,z...]");
}

Expected<MovingScene> load_moving_scene(const SceneOptions& options, const MoveOptions& moves) {
  MovingScene result;
  std::vector<LightPlaces> places;
  std::uint32_t own_lights = 0;
  auto loaded = load_scene_under(options, [&](Scene& scene) -> Expected<void> {
    if (auto done = complete_lights(options, scene); !done) return done;
    auto added = add_places(moves, scene);
    if (!added) return tl::unexpected(std::move(added.error()));
    places = *std::move(added);
    own_lights = static_cast<std::uint32_t>(scene.lights.size());
    for (const LightPlaces& move : places) {
      scene.lights.insert(scene.lights.end(), move.places.begin(), move.places.end());
    }
    return {};
  });
  if (!loaded) return tl::unexpected(std::move(loaded.error()));
  result.loaded = *std::move(loaded);
  if (auto chosen = choose_lights(options, result.loaded, own_lights); !chosen) {
    return tl::unexpected(std::move(chosen.error()));
  }
  const Scene& scene = result.loaded.scene;
  for (const LightPlaces& move : places) {
    if (std::ranges::count(result.loaded.lights, move.light) > 0) continue;
    return fail(ErrorCode::kUsage,
                "--move " + scene.lights[move.light].id + ": it is not asked for",
                "--light " + scene.lights[move.light].id + " too");
  }
  for (const std::uint32_t light : result.loaded.lights) {
    if (!scene.lights[light].has_area()) continue;
    return fail(ErrorCode::kUsage,
                "--move: light " + scene.lights[light].id + " of the scene is an area light",
                "point and directional lights alone, chosen by --light");
  }
  result.steps = steps_of(result.loaded.lights, places, own_lights);
  return result;
}

Expected<void> write_steps(const MovingScene& scene, ShadowOptions options,
                           const report::ResultJsonOptions& json, const std::string& output,
                           bool stats) {
  StepWriter writer(scene, json, output);
  Expected<void> written;
  Stopwatch stopwatch;
  std::size_t step = 0;
  options.steps = scene.steps;
  options.control.step_done = [&](const ShadowResult& result) {
    const Seconds seconds = stopwatch.lap();
    written = writer.write(result);
    if (stats) {
      const std::string text = step_text(step, result.together, seconds);
      std::fwrite(text.data(), 1, text.size(), stderr);
    }
    ++step;
    stopwatch.lap();
    return written.has_value();
  };
  const auto computed = compute_shadows(scene.loaded.prepared, options);
  if (!written) return written;
  if (!computed) return tl::unexpected(computed.error());
  return writer.finish();
}

}  // namespace gnomon::cli
