// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon visible: which part of which polygon an eye sees (Chin & Feiner 1989, sec. 2 and 8). The
// eye is a point light, what it reaches is visible; with lights, in classes of theirs, too.
#include <memory>

#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "cli/common/result_shape.h"
#include "cli/common/scene_options.h"
#include "cli/common/statistics.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/kernel_choice.h"
#include "report/json/result_json.h"

namespace gnomon::cli {

namespace {

struct VisibleOptions : ResultShape {
  SceneOptions scene;
  std::string kernel{kernel_info(kDefaultExactKernel).name};
  std::string algorithm{kAutomaticName};
  bool visible_only = false, stats = false;
  std::string output;
};

ShadowOptions shadow_options_of(const VisibleOptions& options, const LoadedScene& loaded,
                                const KernelChoice& kernel, const AlgorithmChoice& algorithm) {
  ShadowOptions shadows;
  shadows.kernel.id = kernel.kernel;
  shadows.kernel.identity = kernel.identity;
  if (kernel.thin) shadows.kernel.thickness = 0;
  algorithm.apply(shadows.method);
  shadows.tuning.jobs = options.scene.jobs;
  shadows.lights = loaded.lights;
  keep_for(options, shadows.output);
  shadows.output.stage_counts = options.stats;
  shadows.control.interrupted = &interrupted();
  return shadows;
}

Expected<void> write(const VisibleOptions& options, const LoadedScene& loaded,
                     const AlgorithmChoice& algorithm, const ShadowResult& result) {
  report::ResultJsonOptions json = result_json_options(options, loaded, algorithm);
  if (options.visible_only) json.only = LightState::kLit;
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(std::move(output.error()));
  output->give_up_if(interrupted());
  report::write_result_json(*output, loaded.scene, loaded.prepared, result, json);
  return output->finish();
}

Expected<void> see(const VisibleOptions& options) {
  const auto kernel = parse_kernel_choice(options.kernel);
  if (!kernel) return tl::unexpected(kernel.error());
  if (auto checked = check_exactness(options, *kernel); !checked) return checked;
  const bool loops = options.fragments || options.exact_loops;
  const auto algorithm = parse_algorithm_choice(
      options.algorithm, {{"--combined", options.combined, &Method::combines_lights},
                          {"fragments", loops, &Method::makes_fragments}});
  if (!algorithm) return tl::unexpected(algorithm.error());
  const ThreadLimit threads(options.scene.jobs);
  auto loaded = load_scene(options.scene, true);
  if (!loaded) return tl::unexpected(loaded.error());
  if (!options.combined) choose_eye(*loaded);
  warn_of_intent(*loaded);
  ShadowOptions shadows = shadow_options_of(options, *loaded, *kernel, *algorithm);
  ProgressBar progress("visible");
  shadows.control.progress = progress.callback();
  PhaseTimes times;
  Stopwatch stopwatch;
  const auto result = compute_shadows(loaded->prepared, shadows);
  progress.clear();
  if (!result) return tl::unexpected(result.error());
  times.shadows = stopwatch.lap();
  if (auto done = write(options, *loaded, *algorithm, *result); !done) return done;
  times.output = stopwatch.lap();
  if (options.stats) {
    const std::string text = statistics_text(*loaded, *result, times);
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
  return {};
}

}  // namespace

void add_visible_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<VisibleOptions>();
  CLI::App& command =
      *app.add_subcommand("visible", "What an eye sees: which part of which polygon is visible");
  command.footer(
      "The eye is a point light 'eye' of the result; lit is what it sees, shadow what is hidden.\n"
      "Every polygon hides, also one that casts no shadow. gnomon certify SCENE --eye judges it,\n"
      "gnomon render --visible paints it.\n\n"
      "Examples:\n"
      "  gnomon visible room.json --eye 9,-7,6 --fragments -o room.visible.json\n"
      "  gnomon visible room.json --eye 9,-7,6 --combined --algorithm svbsp");
  add_scene_options(command, options->scene);
  command.add_option("--eye", options->scene.eye, "Where the eye is, exactly as its digits say")
      ->required()
      ->type_name("x,y,z");
  add_kernel_option(command, options->kernel);
  add_algorithm_option(command, options->algorithm, "How visible surfaces are found.");
  command.add_flag("--combined", options->combined,
                   "Also the lights: fragments with the set of those that reach each of them, the\n"
                   "eye among them (" +
                       methods_that(&Method::combines_lights) + ")");
  add_shape_options(command, *options);
  command.add_flag("--visible-only", options->visible_only, "List visible fragments only");
  command.add_flag("--stats", options->stats,
                   "Print counts, times, memory and, for plane, who decided, to standard error");
  command.add_option("-o,--output", options->output, "Result file; standard output if absent")
      ->type_name("FILE");
  command.callback([options, &action] {
    action = [options] {
      const auto done = see(*options);
      return done ? kDone : report_error(done.error());
    };
  });
}

}  // namespace gnomon::cli
