// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon shadows: classify a scene on one kernel and write the result.
#include "gnomon/algorithms/shadows.h"

#include <memory>

#include "commands.h"
#include "gnomon/report/number_text.h"
#include "gnomon/report/polygon_sides.h"
#include "gnomon/report/result_json.h"
#include "gnomon/scene/digest.h"
#include "interrupt.h"
#include "kernel_choice.h"
#include "messages.h"
#include "output.h"
#include "progress.h"
#include "scene_options.h"

namespace gnomon::cli {

namespace {

struct ShadowsOptions {
  SceneOptions scene;
  std::string kernel{"plane"};
  std::string algorithm = "svbsp";
  bool identity = false;
  double thickness = kDefaultThickness;
  bool fragments = false, exact_fractions = false, exact_loops = false;
  bool lit_only = false, shadow_only = false;
  bool combined = false;
  bool no_merge = false, no_prefix = false;
  bool stats = false;
  std::string output;
};

void print_stats(const LoadedScene& loaded, const ShadowResult& result) {
  using report::grouped;
  std::string text = "kernel " + result.kernel + ": scene BSP " + grouped(result.bsp_nodes) +
                     " nodes, depth " + grouped(result.bsp_depth) + ", " +
                     grouped(result.bsp_fragments) + " fragments, " +
                     report::rounded(result.scene_bsp_seconds, 3) + " s; shadows " +
                     report::rounded(result.shadow_seconds, 3) + " s\n";
  for (const LightResult& light : result.lights) {
    text += "light " + loaded.scene.lights[loaded.prepared.lights[light.light].light].id + ": " +
            grouped(light.facing_parts) + " parts and " + grouped(light.facing_edges) +
            " edges face it, " + grouped(light.tree_nodes) + " tree nodes, " +
            grouped(light.fragment_total) + " fragments\n";
  }
  const StageCounts& stages = result.stages;
  if (stages.total() > 0) {
    text += "decisions: " + grouped(stages.total()) + "; by identity " + grouped(stages.identity) +
            ", by the filter " + grouped(stages.filter) + ", exactly " + grouped(stages.exact()) +
            " (128 bits " + grouped(stages.exact128) + ", 512 bits " + grouped(stages.exact512) +
            ", GMP " + grouped(stages.unbounded) + "), of these exactly zero " +
            grouped(stages.exactly_zero) + "\n";
  }
  std::fwrite(text.data(), 1, text.size(), stderr);
}

int run_shadows(const ShadowsOptions& options) {
  auto kernel = parse_kernel_choice(options.kernel);
  if (!kernel) return report_error(kernel.error());
  if ((options.exact_fractions || options.exact_loops) && !kernel->exact()) {
    const std::string option = options.exact_fractions ? "--exact-fractions" : "--exact-loops";
    return report_usage(option + ": kernel " + kernel->name() + " rounds",
                        "an exact kernel: plane, rational or epeck");
  }
  auto loaded = load_scene(options.scene, true);
  if (!loaded) return report_error(loaded.error());

  ProgressBar progress("shadows");
  ShadowOptions shadow_options;
  shadow_options.kernel = kernel->kernel;
  shadow_options.identity = options.identity || kernel->identity;
  shadow_options.thickness = kernel->thin ? 0 : options.thickness;
  shadow_options.lights = loaded->lights;
  shadow_options.keep_points = options.fragments || (options.combined && !options.exact_loops);
  shadow_options.keep_exact_points = options.exact_loops;
  shadow_options.exact_fractions = options.exact_fractions;
  shadow_options.combined = options.combined;
  shadow_options.count_stages = options.stats;
  shadow_options.merge = !options.no_merge;
  shadow_options.prefix = !options.no_prefix;
  shadow_options.progress = progress.callback();
  shadow_options.interrupted = &interrupted();
  const auto result = compute_shadows(loaded->prepared, shadow_options);
  progress.clear();
  if (!result) return report_error(result.error());

  report::ResultJsonOptions json_options;
  json_options.geometry_digest = geometry_digest(loaded->scene);
  json_options.fragments = options.fragments;
  json_options.exact_fractions = options.exact_fractions;
  json_options.exact_loops = options.exact_loops;
  json_options.combined = options.combined;
  if (options.lit_only) json_options.only = LightState::kLit;
  if (options.shadow_only) json_options.only = LightState::kShadow;
  auto output = Output::open(options.output);
  if (!output) return report_error(output.error());
  output->give_up_if(interrupted());
  report::write_result_json(*output, loaded->scene, loaded->prepared, *result, json_options);
  if (auto done = output->finish(); !done) return report_error(done.error());
  if (options.stats) print_stats(*loaded, *result);
  return kDone;
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
                  "float, double, longdouble, epick, epeck, rational, plane, or exact (= plane)")
      ->type_name("K")
      ->capture_default_str();
  command.add_option("--algorithm", options->algorithm, "How shadows are found: svbsp")
      ->check(CLI::IsMember({"svbsp"}))
      ->type_name("A")
      ->capture_default_str();
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
                   "Also write fragments with the set of lights that reach each of them");
  auto* lit_only = command.add_flag("--lit-only", options->lit_only, "List lit fragments only");
  command.add_flag("--shadow-only", options->shadow_only, "List shadow fragments only")
      ->excludes(lit_only);
  command.add_flag("--no-merge", options->no_merge, "Leave sibling fragments as the tree cut them");
  command.add_flag("--no-prefix", options->no_prefix,
                   "Without the balanced prefix: the tree of the 1989 paper");
  command.add_flag("--stats", options->stats,
                   "Print counts, CPU times and, for plane, who decided, to standard error");
  command.add_option("-o,--output", options->output, "Result file; standard output if absent")
      ->type_name("FILE");
  command.callback([options, &action] { action = [options] { return run_shadows(*options); }; });
}

}  // namespace gnomon::cli
