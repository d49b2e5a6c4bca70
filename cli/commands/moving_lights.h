// SPDX-License-Identifier: GPL-3.0-or-later
// --move of gnomon shadows: lights that take several places one after another, and the result of
// each step (docs/moving-lights.md).
#ifndef GNOMON_CLI_COMMANDS_MOVING_LIGHTS_H
#define GNOMON_CLI_COMMANDS_MOVING_LIGHTS_H

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/kernel/error.h"
#include "report/json/result_json.h"

namespace gnomon::cli {

struct MoveOptions {
  std::vector<std::string> moves;  // LIGHT=x,y,z[:x,y,z...]

  bool given() const { return !moves.empty(); }
};

/// `combined`: the option that it needs.
void add_move_option(CLI::App& command, MoveOptions& options, CLI::Option* combined);

/// A scene whose lights are at all their places; LoadedScene::lights are those of the first step.
struct MovingScene {
  LoadedScene loaded;
  /// The lights of each further step: ShadowOptions::steps.
  std::vector<std::vector<std::uint32_t>> steps;
};

/// As load_scene(). Errors: its, and those of parse_light_places(); kUsage for a light that is
/// moved twice, or that is not asked for, and for area lights among those asked for.
Expected<MovingScene> load_moving_scene(const SceneOptions& options, const MoveOptions& moves);

/// Computes all steps and writes each as soon as it is there: to files of its own if `output` has
/// "%d" in it, else to one file with all of them. `stats`: also a line for each step on standard
/// error.
Expected<void> write_steps(const MovingScene& scene, ShadowOptions options,
                           const report::ResultJsonOptions& json, const std::string& output,
                           bool stats);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_MOVING_LIGHTS_H
