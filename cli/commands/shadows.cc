// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon shadows: classify a scene on one kernel and write the result.
#include "gnomon/algorithms/shadows.h"

#include <array>
#include <memory>

#include "cli/commands/illuminate.h"
#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "cli/common/scene_options.h"
#include "cli/common/statistics.h"
#include "gnomon/algorithms/deep_umbra.h"
#include "gnomon/kernel/kernel_choice.h"
#include "gnomon/scene/digest.h"
#include "report/json/result_json.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

struct ShadowsOptions {
  SceneOptions scene;
  std::string kernel{"plane"};
  std::string algorithm{kAutomaticName};
  bool identity = false;
  double thickness = kDefaultThickness;
  bool fragments = false, exact_fractions = false, exact_loops = false;
  bool lit_only = false, shadow_only = false, penumbra_only = false, umbra_only = false;
  bool combined = false;
  bool no_merge = false, no_prefix = false, pieces = false;
  bool deep_umbra = false;
  double deep_umbra_tolerance = 1e-3;
  bool stats = false;
  IlluminateOptions illuminate;
  std::string output;
};

int run_shadows(const ShadowsOptions& options) {
  auto kernel = parse_kernel_choice(options.kernel);
  if (!kernel) return report_error(kernel.error());
  auto algorithm = parse_algorithm_choice(
      options.algorithm, {{"--combined", options.combined, &Method::combines_lights},
                          {"--fragments", options.fragments, &Method::makes_fragments},
                          {"--exact-loops", options.exact_loops, &Method::makes_fragments},
                          {"--illuminate", options.illuminate.illuminate, &Method::makes_fragments},
                          {"--no-merge", options.no_merge, &Method::leaves_out_steps},
                          {"--no-prefix", options.no_prefix, &Method::leaves_out_steps}});
  if (!algorithm) return report_error(algorithm.error());
  if (options.pieces) {
    if (algorithm->point == MethodId::kReceiver) {
      return report_usage("--pieces needs merged, not receiver", "--algorithm merged, or auto");
    }
    algorithm->area = MethodId::kPieces;
  }
  for (const auto& [option, given] : {std::pair("--exact-fractions", options.exact_fractions),
                                      std::pair("--exact-loops", options.exact_loops),
                                      std::pair("--deep-umbra", options.deep_umbra)}) {
    if (!given || kernel->exact()) continue;
    return report_usage(std::string(option) + ": kernel " + kernel->name() + " rounds",
                        "an exact kernel: plane, rational or epeck");
  }
  if (options.deep_umbra && options.pieces) {
    return report_usage("--deep-umbra is of whole lights", "no --pieces");
  }
  if (options.illuminate.illuminate && options.pieces) {
    return report_usage("--illuminate is by whole lights", "no --pieces");
  }
  const ThreadLimit threads(options.scene.jobs);
  auto loaded = load_scene(options.scene, true);
  if (!loaded) return report_error(loaded.error());

  ProgressBar progress("shadows");
  ShadowOptions shadow_options;
  shadow_options.kernel.id = kernel->kernel;
  algorithm->apply(shadow_options.method);
  shadow_options.tuning.jobs = options.scene.jobs;
  shadow_options.kernel.identity = options.identity || kernel->identity;
  shadow_options.kernel.thickness = kernel->thin ? 0 : options.thickness;
  shadow_options.lights = loaded->lights;
  shadow_options.output.points = options.fragments || (options.combined && !options.exact_loops);
  shadow_options.output.exact_points = options.exact_loops || options.deep_umbra;
  shadow_options.output.exact_fractions = options.exact_fractions;
  shadow_options.output.combined = options.combined;
  shadow_options.output.stage_counts = options.stats;
  shadow_options.output.merge = !options.no_merge;
  shadow_options.method.prefix = !options.no_prefix;
  shadow_options.control.progress = progress.callback();
  shadow_options.control.interrupted = &interrupted();
  if (auto done =
          ask_for_illumination(options.illuminate, *loaded, options.algorithm, shadow_options);
      !done) {
    return report_error(done.error());
  }
  if (options.illuminate.illuminate && options.illuminate.mesh.empty() && !options.stats) {
    return report_usage("--illuminate writes nothing by itself", "--mesh FILE, or --stats");
  }
  PhaseTimes times;
  Stopwatch stopwatch;
  const auto result = compute_shadows(loaded->prepared, shadow_options);
  times.shadows = stopwatch.lap();
  progress.clear();
  if (!result) return report_error(result.error());

  report::ResultJsonOptions json_options;
  json_options.geometry_digest = geometry_digest(loaded->scene);
  json_options.fragments = options.fragments;
  json_options.exact_fractions = options.exact_fractions;
  json_options.exact_loops = options.exact_loops;
  json_options.combined = options.combined && !algorithm->paints();
  json_options.overlay = options.combined && algorithm->paints();
  json_options.interrupted = &interrupted();
  if (options.lit_only) json_options.only = LightState::kLit;
  if (options.shadow_only) json_options.only = LightState::kShadow;
  if (options.penumbra_only) json_options.only = LightState::kPenumbra;
  if (options.umbra_only) json_options.only = LightState::kUmbra;
  if (options.deep_umbra) {
    for (const LightResult& light : result->lights) {
      auto& bounds = json_options.deep_umbra.emplace_back();
      if (!loaded->prepared.lights[light.light].has_area()) continue;
      DeepUmbraOptions deep_options;
      deep_options.tolerance = options.deep_umbra_tolerance;
      deep_options.interrupted = &interrupted();
      auto found = deep_umbra_bounds(loaded->prepared, light, deep_options);
      if (!found) return report_error(found.error());
      bounds = std::move(*found);
    }
    const Seconds deep = stopwatch.lap();
    times.shadows.cpu += deep.cpu;
    times.shadows.elapsed += deep.elapsed;
  }
  auto output = Output::open(options.output);
  if (!output) return report_error(output.error());
  output->give_up_if(interrupted());
  report::write_result_json(*output, loaded->scene, loaded->prepared, *result, json_options);
  if (auto done = output->finish(); !done) return report_error(done.error());
  times.output = stopwatch.lap();
  if (options.stats) {
    const std::string text = statistics_text(*loaded, *result, times);
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
  const auto illuminated = illuminate(options.illuminate, *loaded, *result);
  return illuminated ? kDone : report_error(illuminated.error());
}

}  // namespace

void add_shadows_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ShadowsOptions>();
  CLI::App& command =
      *app.add_subcommand("shadows", "Classify a scene: which part of which polygon is lit");
  command.footer(
      "Example:\n  gnomon shadows room.json --kernel exact --exact-fractions --fragments -o "
      "room.result.json");
  add_scene_options(command, options->scene);
  command
      .add_option("--kernel", options->kernel,
                  kernel_names(", ") +
                      ", or exact (= " + std::string(kernel_info(kDefaultExactKernel).name) + ")")
      ->type_name("K")
      ->capture_default_str();
  add_algorithm_option(command, options->algorithm);
  command.add_flag("--identity", options->identity,
                   "Rounded kernels: a vertex made by a plane is on it, whatever its numbers say");
  command
      .add_option(
          "--thickness", options->thickness,
          "Rounded kernels: half the thickness of a plane, relative to the scene's diagonal")
      ->check(not_negative())
      ->type_name("F")
      ->default_str(report::shortest(kDefaultThickness));
  command.add_flag("--fragments", options->fragments, "Write the fragments, as nearest doubles");
  command.add_flag("--exact-fractions", options->exact_fractions,
                   "Write fractions as exact rationals \"p/q\" (exact kernels)");
  command.add_flag("--exact-loops", options->exact_loops,
                   "Write fragments with exact rational coordinates (exact kernels)");
  command.add_flag("--combined", options->combined,
                   "Also write fragments with the set of lights that reach each of them\n(" +
                       methods_that(&Method::combines_lights) + ")");
  command.add_flag("--pieces", options->pieces,
                   "Area lights cut by the planes of all polygons first, classes for each piece\n"
                   "(Chin & Feiner 1992 cut by fewer planes)");
  auto* deep_umbra = command.add_flag(
      "--deep-umbra", options->deep_umbra,
      "Area lights: also bounds of the share of each polygon that no light reaches, whatever\n"
      "hides it (exact kernels)");
  command
      .add_option("--deep-umbra-tolerance", options->deep_umbra_tolerance,
                  "Share of each part that may stay undecided")
      ->check(not_negative())
      ->needs(deep_umbra)
      ->type_name("F")
      ->default_str("1e-3");
  const std::array<CLI::Option*, 4> only{
      command.add_flag("--lit-only", options->lit_only, "List lit fragments only"),
      command.add_flag("--shadow-only", options->shadow_only,
                       "List fragments that are not lit: shadow, penumbra and umbra"),
      command.add_flag("--penumbra-only", options->penumbra_only, "List penumbra fragments only"),
      command.add_flag("--umbra-only", options->umbra_only, "List umbra fragments only")};
  for (std::size_t i = 0; i < only.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) only[i]->excludes(only[j]);
  }
  command.add_flag("--no-merge", options->no_merge,
                   "Leave sibling fragments as the tree cut them (svbsp)");
  command.add_flag("--no-prefix", options->no_prefix,
                   "Without the balanced prefix: the tree of the 1989 paper (svbsp)");
  add_mesh_option(command, options->illuminate,
                  add_illuminate_options(command, options->illuminate,
                                         "Compute the illumination of the fragments' vertices, for "
                                         "--mesh or --stats (exact\nkernels)"));
  command.add_flag("--stats", options->stats,
                   "Print counts, times, memory and, for plane, who decided, to standard error");
  command.add_option("-o,--output", options->output, "Result file; standard output if absent")
      ->type_name("FILE");
  command.callback([options, &action] {
    options->illuminate.stats = options->stats;
    action = [options] { return run_shadows(*options); };
  });
}

}  // namespace gnomon::cli
