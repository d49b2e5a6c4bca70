// SPDX-License-Identifier: GPL-3.0-or-later
// The options that say which scene and which of its lights: shared by all commands that read one.
#ifndef GNOMON_CLI_COMMON_SCENE_OPTIONS_H
#define GNOMON_CLI_COMMON_SCENE_OPTIONS_H

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/common/stopwatch.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/scene.h"

namespace gnomon::cli {

struct SceneOptions {
  std::string scene;
  std::string numbers;
  std::vector<std::string> points, suns, areas;
  std::string lights_file;
  std::vector<std::string> lights;        // ids; empty: all
  std::vector<std::string> cones, flaps;  // where point and directional lights shine
  std::string eye;                        // x,y,z of a light `eye`, the last one; empty: none
  unsigned jobs = 0;                      // threads; 0: one a processor
  bool two_sided = false;                 // all polygons, whatever the file says
  bool skip_bad = false;                  // polygons that cannot be used are left out
  bool keep_axes = false;                 // of energy models, where the command turns its suns
  std::string lod;                        // of CityJSON; empty: the highest
  std::string up;                         // "y" or "z"; empty: as the format has it
};

/// Also --jobs, since preparation takes all processors. The option of the scene's file is returned:
/// a command may do without.
CLI::Option* add_scene_options(CLI::App& command, SceneOptions& options);
/// The same without lights, for commands that have their own.
CLI::Option* add_scene_file_options(CLI::App& command, SceneOptions& options);
/// --numbers alone, for commands that take no lights.
void add_numbers_option(CLI::App& command, std::string& numbers);

/// A scene as read, and what was left out of it.
struct SceneAsRead {
  Scene scene;
  std::vector<LeftOutPolygon> left_out;
};

struct LoadedScene {
  Scene scene;
  std::vector<LeftOutPolygon> left_out;
  PreparedScene prepared;
  std::vector<std::uint32_t> lights;  // asked for, in file order: indices into both scenes' lights
  Seconds reading, preparation;
};

/// The number meaning that was asked for, if any.
std::optional<NumberMeaning> numbers_asked(const std::string& numbers);

/// Reads the scene and adds the command line's lights; prints warnings.
Expected<SceneAsRead> read_scene_with_lights(const SceneOptions& options);

/// The options for reading that were asked for.
ReadOptions read_options(const SceneOptions& options);

/// The id of the light that stands for an eye.
inline constexpr const char* kEyeId = "eye";

/// The same, prepared and with the lights chosen; the eye is, if there is one. Errors: those of
/// reading and preparing; kUsage for an unknown --light, and for a scene that is left without any
/// light if `needs_light`.
Expected<LoadedScene> load_scene(const SceneOptions& options, bool needs_light);
/// Chooses the eye alone of the lights. Requires: there is one.
void choose_eye(LoadedScene& loaded);
/// Adds the eye to the scene's lights, if there is one, and says where they shine. Errors: those of
/// the options' texts; kId for a light called as the eye is.
Expected<void> complete_lights(const SceneOptions& options, Scene& scene);
/// Chooses the lights asked for among the first `count` of the scene. Errors: kUsage for an unknown
/// --light.
Expected<void> choose_lights(const SceneOptions& options, LoadedScene& loaded, std::size_t count);
/// The same with whatever lights `set_lights` gives the scene that was read. Errors: its, too.
Expected<LoadedScene> load_scene_under(const SceneOptions& options,
                                       const std::function<Expected<void>(Scene&)>& set_lights);

/// One warning if the scene perhaps does not mean what its numbers say (gnomon/scene/intent.h). Of
/// a large scene only what costs next to nothing is looked at: `gnomon info` looks at everything.
void warn_of_intent(const LoadedScene& loaded);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_SCENE_OPTIONS_H
