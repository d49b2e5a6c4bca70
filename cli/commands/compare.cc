// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon compare: systems beside each other, on scenes by sizes (comparison/README.md); and
// gnomon measure, the process of one run.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/common/algorithm_choice.h"
#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "comparison/comparison.h"
#include "comparison/comparison_text.h"
#include "comparison/run_measurement.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/kernel_choice.h"

namespace gnomon::cli {

namespace {

struct CompareCommandOptions {
  std::vector<std::string> scenes, algorithms, kernels;
  std::vector<std::uint64_t> sizes;
  std::uint64_t seed = 1, repeat = 0, certify_up_to = comparison::kCertifyUpTo;
  std::string time;
  std::uint64_t megabytes = comparison::RunLimits{}.megabytes;
  bool commands = false, counters = false, times = false;
  std::string json, csv;
};

template <class Text>
void add_once(std::vector<std::string>& texts, Text text) {
  if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
}

Expected<void> add_kernels(const std::vector<std::string>& names,
                           std::vector<std::string>& kernels) {
  for (const std::string& name : names) {
    if (name == kAllName) {
      for (const KernelInfo& info : kernel_list()) {
        if (has_kernel(info.id)) add_once(kernels, std::string(info.name));
      }
      continue;
    }
    const auto kernel = parse_kernel_choice(name);
    if (!kernel) return tl::unexpected(kernel.error());
    add_once(kernels, kernel->name());
  }
  return {};
}

Expected<comparison::ComparePlan> plan_of(const CompareCommandOptions& options) {
  comparison::ComparePlan plan;
  for (const std::string& text : options.scenes) {
    auto scene = comparison::SceneSource::parse(text);
    if (!scene) return tl::unexpected(scene.error());
    plan.scenes.push_back(std::move(*scene));
  }
  bool all = options.algorithms.empty();
  for (const std::string& text : options.algorithms) {
    if (text == kAllName) {
      all = true;
      continue;
    }
    const auto method = parse_method(text);
    if (!method) {
      Error error = method.error();
      error.what = "--algorithm " + error.what;
      return tl::unexpected(std::move(error));
    }
    add_once(plan.systems, method_text(method->id, method->values));
  }
  if (all) plan.systems.clear();
  const std::vector<std::string> usual = {"double", "plane"};
  const auto added = add_kernels(options.kernels.empty() ? usual : options.kernels, plan.kernels);
  if (!added) return tl::unexpected(added.error());
  plan.sizes = options.sizes;
  plan.seed = options.seed;
  plan.repeat = options.repeat;
  plan.certify_up_to = options.certify_up_to;
  if (!options.time.empty()) plan.limits.seconds = duration_seconds(options.time);
  plan.limits.megabytes = options.megabytes;
  return plan;
}

int status_of(const comparison::Comparison& comparison) {
  if (comparison.interrupted) return kInterruptedStatus;
  return comparison.contradictions.empty() ? kDone : kDisagree;
}

int run_compare(const CompareCommandOptions& options) {
  const auto plan = plan_of(options);
  if (!plan) return report_error(plan.error());
  const auto program = own_program();
  if (!program) return report_error(program.error());

  ProgressLine line;
  comparison::CompareControl control;
  control.interrupted = &interrupted();
  control.progress = [&](const comparison::RunRequest& request, std::size_t done, std::size_t all) {
    line.show("compare " + std::to_string(done) + " of " + std::to_string(all) + ": " +
              request.scene + (request.size ? ", size " + std::to_string(*request.size) : "") +
              ", " + request.kernel + '/' + request.system);
  };
  const auto comparison = comparison::compare(*plan, {*program, {"measure"}}, control);
  line.clear();
  if (!comparison) return report_error(comparison.error());

  if (options.json != "-" && options.csv != "-") {
    const std::string text =
        comparison::comparison_text(*comparison, {options.commands, options.counters});
    if (auto done = write_output({}, text); !done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    comparison::write_comparison_json(*output, *comparison, options.times);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  if (!options.csv.empty()) {
    const auto done =
        write_output(options.csv, comparison::comparison_csv(*comparison, options.times));
    if (!done) return report_error(done.error());
  }
  return status_of(*comparison);
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<CompareCommandOptions>();
  CLI::App& command = *app.add_subcommand(
      "compare", "Systems beside each other: verdict, work, time and growth, in one table");
  command.footer(
      "Each run is a process of its own on one thread; one that crashes or exceeds a limit is a\n"
      "row. Times are CPU time of classification, as ratios to svbsp (area lights: receiver) on\n"
      "double of the same run.\n\n"
      "Examples:\n"
      "  gnomon compare city --size 100 --size 1000 --size 10000\n"
      "  gnomon compare quads:two_sided=1 room.json --algorithm svbsp --algorithm tiling:tiles=64");
  command
      .add_option("SCENE", options->scenes,
                  "Scenes of 'gnomon generate' as NAME[:parameter=value,...], files, or generators "
                  "of campaigns")
      ->required()
      ->type_name("FAMILY|SCENE...");
  repeatable(command.add_option("--algorithm", options->algorithms,
                                "A system with its options (repeatable; gnomon systems lists "
                                "them); absent or all:\nevery one that takes the scene's lights"))
      ->type_name("A");
  repeatable(command.add_option("--kernel", options->kernels,
                                "A kernel (repeatable), or all; double and plane if absent"))
      ->type_name("K");
  repeatable(command.add_option("--size", options->sizes,
                                "Polygons of a family's scene, at most (repeatable); absent: the "
                                "family's default"))
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command.add_option("--seed", options->seed, "Seed of what is random")
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--certify-up-to", options->certify_up_to,
                  "Scenes of at most so many polygons are judged by the oracle")
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--repeat", options->repeat,
                  "Times that each run is measured, of which the median counts; 0: 3 to 25 times, "
                  "once\nwhat is long")
      ->type_name("R")
      ->capture_default_str();
  command.add_option("--time", options->time, "Of the clock, for one run with its judging; 60s")
      ->check(duration())
      ->type_name("T");
  command.add_option("--memory", options->megabytes, "Megabytes for one run; 0: no limit")
      ->type_name("M")
      ->capture_default_str();
  command.add_flag("--counters", options->counters, "Print all that each system counts");
  command.add_flag("--commands", options->commands, "Print the command that repeats each row");
  command.add_flag("--times", options->times,
                   "Seconds, ratios, memory and growth in JSON and CSV too");
  command
      .add_option("--json", options->json, "Write the rows as JSON; - for standard output alone")
      ->type_name("FILE");
  command.add_option("--csv", options->csv, "Write the rows as CSV; - for standard output alone")
      ->type_name("FILE");
  command.callback([options, &action] { action = [options] { return run_compare(*options); }; });
}

void add_measure_command(CLI::App& app, Action& action) {
  auto request = std::make_shared<std::string>();
  CLI::App& command = *app.add_subcommand("measure", "One run of a comparison; not for people");
  command.group("");
  command.add_option("REQUEST", *request)->required();
  command.callback([request, &action] {
    action = [request] { return comparison::measurement_main(*request); };
  });
}

}  // namespace gnomon::cli
