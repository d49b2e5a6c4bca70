// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon shadows: classify a scene on one kernel and write the result.
#include "gnomon/algorithms/shadows.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "cli/commands/exports.h"
#include "cli/commands/extras.h"
#include "cli/commands/illuminate.h"
#include "cli/commands/moving_lights.h"
#include "cli/commands/share_output.h"
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
#include "gnomon/algorithms/deep_umbra.h"
#include "gnomon/kernel/kernel_choice.h"
#include "report/json/result_json.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

struct ShadowsOptions : ResultShape {
  SceneOptions scene;
  std::string kernel{"plane"};
  std::string algorithm{kAutomaticName};
  bool identity = false;
  double thickness = kDefaultThickness;
  bool lit_only = false, shadow_only = false, penumbra_only = false, umbra_only = false;
  MoveOptions move;
  bool no_merge = false, no_prefix = false, pieces = false;
  bool deep_umbra = false;
  double deep_umbra_tolerance = 1e-3;
  bool stats = false;
  IlluminateOptions illuminate;
  ExtrasOptions extras;
  ExportOptions exports;
  std::string output, shares;

  /// Whether anyone asks for the lights after the table of shares.
  bool keeps_lights() const { return !output.empty() || illuminate.illuminate || exports.given(); }
  /// Without a name the result goes to standard output, unless something else was asked for.
  bool writes_result() const { return !output.empty() || (shares.empty() && !exports.given()); }
};

/// Options that say what the result file holds.
std::vector<std::pair<const char*, bool>> result_options(const ShadowsOptions& options) {
  std::vector<std::pair<const char*, bool>> all{
      {"--fragments", options.fragments},     {"--exact-fractions", options.exact_fractions},
      {"--exact-loops", options.exact_loops}, {"--combined", options.combined},
      {"--deep-umbra", options.deep_umbra},   {"--lit-only", options.lit_only},
      {"--shadow-only", options.shadow_only}, {"--penumbra-only", options.penumbra_only},
      {"--umbra-only", options.umbra_only}};
  std::ranges::move(options.extras.given(), std::back_inserter(all));
  return all;
}

Expected<void> check_pieces(const ShadowsOptions& options) {
  if (!options.pieces) return {};
  for (const auto& [text, given] :
       {std::pair("--deep-umbra is of whole lights", options.deep_umbra),
        std::pair("--illuminate is by whole lights", options.illuminate.illuminate),
        std::pair("--shares is of whole lights", !options.shares.empty())}) {
    if (given) return fail(ErrorCode::kUsage, text, "no --pieces");
  }
  return {};
}

Expected<void> check_move(const ShadowsOptions& options) {
  if (!options.move.given()) return {};
  std::vector<std::pair<const char*, bool>> others{{"--shares", !options.shares.empty()},
                                                   {"--export", options.exports.given()},
                                                   {"--deep-umbra", options.deep_umbra},
                                                   {"--pieces", options.pieces},
                                                   {"--illuminate", options.illuminate.illuminate}};
  std::ranges::move(options.extras.given(), std::back_inserter(others));
  for (const auto& [option, given] : others) {
    if (!given) continue;
    return fail(ErrorCode::kUsage, std::string(option) + " is of one result, --move makes several",
                "no --move");
  }
  return {};
}

/// What does not go together, whatever the scene is.
Expected<void> check_options(const ShadowsOptions& options, const KernelChoice& kernel) {
  if (auto checked = check_exactness(options, kernel); !checked) return checked;
  if (options.deep_umbra && !kernel.exact()) {
    return needs_exact_kernel("--deep-umbra", kernel.name());
  }
  if (auto checked = check_pieces(options); !checked) return checked;
  if (auto checked = check_move(options); !checked) return checked;
  if (auto checked = check_exports(options.exports); !checked) return checked;
  if (options.writes_result()) return {};
  const std::string alone = options.shares.empty() ? "--export" : "--shares";
  for (const auto& [option, given] : result_options(options)) {
    if (!given) continue;
    return fail(ErrorCode::kUsage,
                std::string(option) + " is of the result, which " + alone + " alone does not write",
                "-o FILE too");
  }
  return {};
}

ShadowOptions shadow_options_of(const ShadowsOptions& options, const LoadedScene& loaded,
                                const KernelChoice& kernel, const AlgorithmChoice& algorithm) {
  ShadowOptions shadows;
  shadows.kernel.id = kernel.kernel;
  shadows.kernel.identity = options.identity || kernel.identity;
  shadows.kernel.thickness = kernel.thin ? 0 : options.thickness;
  algorithm.apply(shadows.method);
  shadows.method.prefix = !options.no_prefix;
  shadows.tuning.jobs = options.scene.jobs;
  shadows.lights = loaded.lights;
  keep_for(options, shadows.output);
  if (options.deep_umbra) shadows.output.exact_points = true;
  if (options.exports.given()) shadows.output.points = true;
  shadows.output.stage_counts = options.stats;
  shadows.output.merge = !options.no_merge;
  shadows.control.interrupted = &interrupted();
  return shadows;
}

/// The counts of a light alone, for --stats.
LightResult counts_of(const LightResult& light) {
  LightResult counts;
  counts.light = light.light;
  counts.method = light.method;
  counts.facing_parts = light.facing_parts;
  counts.facing_edges = light.facing_edges;
  counts.tree_nodes = light.tree_nodes;
  counts.fragment_total = light.fragment_total;
  counts.work = light.work;
  return counts;
}

/// Classifies all lights. The table of shares gets each light as soon as it is done; the lights are
/// then kept only as far as someone asks for them later.
Expected<ShadowResult> classify(const ShadowsOptions& options, const LoadedScene& loaded,
                                ShadowOptions shadows, PhaseTimes& times) {
  Stopwatch stopwatch;
  if (options.shares.empty()) {
    auto result = compute_shadows(loaded.prepared, shadows);
    times.shadows = stopwatch.lap();
    return result;
  }
  auto table = ShareOutput::open(options.shares, loaded, shadows.kernel.id);
  if (!table) return tl::unexpected(std::move(table.error()));
  std::vector<LightResult> kept;
  shadows.control.light_done = [&](LightResult&& light) {
    times.shadows += stopwatch.lap();
    const bool written = table->add(light);
    times.output += stopwatch.lap();
    if (options.keeps_lights()) {
      kept.push_back(std::move(light));
    } else if (options.stats) {
      kept.push_back(counts_of(light));
    }
    return written;
  };
  auto result = compute_shadows(loaded.prepared, shadows);
  times.shadows += stopwatch.lap();
  if (!result && !(result.error().code == ErrorCode::kInterrupted)) return result;
  if (auto done = table->finish(); !done) return tl::unexpected(std::move(done.error()));
  times.output += stopwatch.lap();
  if (result) result->lights = std::move(kept);
  return result;
}

/// Bounds of the deep umbra of all lights, none for those that are no area lights.
Expected<std::vector<std::vector<DeepUmbraBounds>>> deep_umbra_of(const ShadowsOptions& options,
                                                                  const LoadedScene& loaded,
                                                                  const ShadowResult& result) {
  std::vector<std::vector<DeepUmbraBounds>> all;
  if (!options.deep_umbra) return all;
  for (const LightResult& light : result.lights) {
    auto& bounds = all.emplace_back();
    if (!loaded.prepared.lights[light.light].has_area()) continue;
    DeepUmbraOptions deep;
    deep.tolerance = options.deep_umbra_tolerance;
    deep.interrupted = &interrupted();
    auto found = deep_umbra_bounds(loaded.prepared, light, deep);
    if (!found) return tl::unexpected(std::move(found.error()));
    bounds = std::move(*found);
  }
  return all;
}

/// What the result's file holds, but for what is computed from the result.
report::ResultJsonOptions json_options_of(const ShadowsOptions& options, const LoadedScene& loaded,
                                          const AlgorithmChoice& algorithm) {
  report::ResultJsonOptions json = result_json_options(options, loaded, algorithm);
  if (options.lit_only) json.only = LightState::kLit;
  if (options.shadow_only) json.only = LightState::kShadow;
  if (options.penumbra_only) json.only = LightState::kPenumbra;
  if (options.umbra_only) json.only = LightState::kUmbra;
  return json;
}

Expected<void> write_result(const ShadowsOptions& options, const LoadedScene& loaded,
                            const AlgorithmChoice& algorithm, const ShadowOptions& shadows,
                            const ShadowResult& result, PhaseTimes& times) {
  Stopwatch stopwatch;
  report::ResultJsonOptions json = json_options_of(options, loaded, algorithm);
  times.output += stopwatch.lap();
  auto deep_umbra = deep_umbra_of(options, loaded, result);
  if (!deep_umbra) return tl::unexpected(std::move(deep_umbra.error()));
  json.deep_umbra = std::move(*deep_umbra);
  const auto extras = find_extras(options.extras, loaded, shadows);
  if (!extras) return tl::unexpected(extras.error());
  json.extras = &*extras;
  times.shadows += stopwatch.lap();
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(std::move(output.error()));
  output->give_up_if(interrupted());
  report::write_result_json(*output, loaded.scene, loaded.prepared, result, json);
  auto done = output->finish();
  times.output += stopwatch.lap();
  return done;
}

/// Whether `auto` may take the method that makes no fragments: as compute_shadows() does.
bool asks_for_shares_alone(const ShadowsOptions& options, const KernelChoice& kernel) {
  return options.algorithm == kAutomaticName && kernel_info(kernel.kernel).exact &&
         !options.fragments && !options.exact_loops && !options.exact_fractions &&
         !options.combined && !options.deep_umbra && !options.extras.centroids &&
         !options.illuminate.illuminate && !options.exports.given();
}

int run_moving(const ShadowsOptions& options, const KernelChoice& kernel,
               const AlgorithmChoice& algorithm) {
  auto scene = load_moving_scene(options.scene, options.move);
  if (!scene) return report_error(scene.error());
  warn_of_intent(scene->loaded);
  ProgressBar progress("shadows");
  ShadowOptions shadows = shadow_options_of(options, scene->loaded, kernel, algorithm);
  shadows.control.progress = progress.callback();
  const auto done =
      write_steps(*scene, std::move(shadows), json_options_of(options, scene->loaded, algorithm),
                  options.output, options.stats);
  progress.clear();
  return done ? kDone : report_error(done.error());
}

int run_shadows(const ShadowsOptions& options) {
  auto kernel = parse_kernel_choice(options.kernel);
  if (!kernel) return report_error(kernel.error());
  auto algorithm = parse_algorithm_choice(
      options.algorithm, {{"--combined", options.combined, &Method::combines_lights},
                          {"--move", options.move.given(), &Method::moves_lights},
                          {"--fragments", options.fragments, &Method::makes_fragments},
                          {"--exact-loops", options.exact_loops, &Method::makes_fragments},
                          {"--illuminate", options.illuminate.illuminate, &Method::makes_fragments},
                          {"--centroids", options.extras.centroids, &Method::makes_fragments},
                          {"--export", options.exports.given(), &Method::makes_fragments},
                          {"--no-merge", options.no_merge, &Method::leaves_out_steps},
                          {"--no-prefix", options.no_prefix, &Method::leaves_out_steps}});
  if (!algorithm) return report_error(algorithm.error());
  if (asks_for_shares_alone(options, *kernel)) {
    if (algorithm->point == MethodId::kSectors) algorithm->point = MethodId::kAutomatic;
    algorithm->area = MethodId::kAutomatic;
  }
  if (options.pieces) {
    for (const MethodId other : {MethodId::kReceiver, MethodId::kContour}) {
      if (algorithm->point != other) continue;
      const std::string name(method_info(other).name);
      return report_usage("--pieces needs merged, not " + name, "--algorithm merged, or auto");
    }
    algorithm->area = MethodId::kPieces;
  }
  if (auto checked = check_options(options, *kernel); !checked) {
    return report_error(checked.error());
  }
  const ThreadLimit threads(options.scene.jobs);
  if (options.move.given()) return run_moving(options, *kernel, *algorithm);
  auto loaded = load_scene(options.scene, !options.extras.works_without_light());
  if (!loaded) return report_error(loaded.error());
  warn_of_intent(*loaded);
  ProgressBar progress("shadows");
  ShadowOptions shadow_options = shadow_options_of(options, *loaded, *kernel, *algorithm);
  shadow_options.control.progress = progress.callback();
  if (auto done =
          ask_for_illumination(options.illuminate, *loaded, options.algorithm, shadow_options);
      !done) {
    return report_error(done.error());
  }
  if (auto done = ask_for_extras(options.extras, *loaded, shadow_options); !done) {
    return report_error(done.error());
  }
  if (options.illuminate.illuminate && options.illuminate.mesh.empty() && !options.stats) {
    return report_usage("--illuminate writes nothing by itself", "--mesh FILE, or --stats");
  }
  PhaseTimes times;
  const auto result = classify(options, *loaded, shadow_options, times);
  progress.clear();
  if (!result) return report_error(result.error());
  if (options.writes_result()) {
    if (auto done = write_result(options, *loaded, *algorithm, shadow_options, *result, times);
        !done) {
      return report_error(done.error());
    }
  }
  if (auto done = write_exports(options.exports, *loaded, *result); !done) {
    return report_error(done.error());
  }
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
  add_kernel_option(command, options->kernel);
  add_algorithm_option(command, options->algorithm, "How shadows are found.",
                       "auto: contour for classes and shares alone, if the kernel allows it;\n"
                       "else sectors and receiver wherever they can do what is asked");
  command.add_flag("--identity", options->identity,
                   "Rounded kernels: a vertex made by a plane is on it, whatever its numbers say");
  command
      .add_option(
          "--thickness", options->thickness,
          "Rounded kernels: half the thickness of a plane, relative to the scene's diagonal")
      ->check(not_negative())
      ->type_name("F")
      ->default_str(report::shortest(kDefaultThickness));
  add_shape_options(command, *options);
  auto* combined =
      command.add_flag("--combined", options->combined,
                       "Also write fragments with the set of lights that reach each of them\n(" +
                           methods_that(&Method::combines_lights) + ")");
  add_move_option(command, options->move, combined);
  command.add_flag("--pieces", options->pieces,
                   "Area lights cut first by the planes of polygons that have a part in front of\n"
                   "them (Chin & Feiner 1992), classes for each piece");
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
  add_extras_options(command, options->extras);
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
  command
      .add_option("--shares", options->shares,
                  "Write the lit share of every polygon under every light as a table, light by "
                  "light: .csv,\nor .npy for NumPy. Without -o no result is written then")
      ->type_name("FILE");
  add_export_option(command, options->exports);
  command.callback([options, &action] {
    options->illuminate.stats = options->stats;
    action = [options] { return run_shadows(*options); };
  });
}

}  // namespace gnomon::cli
