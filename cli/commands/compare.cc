// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon compare: systems beside each other, on scenes by sizes (comparison/README.md); and
// gnomon measure, the process of one run.
#include <memory>
#include <string>
#include <vector>

#include "cli/commands/comparison_options.h"
#include "cli/commands/measured_report.h"
#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "comparison/comparison.h"
#include "comparison/comparison_text.h"
#include "comparison/run_measurement.h"

namespace gnomon::cli {

namespace {

struct CompareCommandOptions : ComparisonOptions {
  bool counters = false, times = false;
};

Expected<comparison::ComparePlan> plan_of(const CompareCommandOptions& options) {
  comparison::ComparePlan plan;
  auto scenes = options.sources();
  if (!scenes) return tl::unexpected(scenes.error());
  auto systems = options.systems();
  if (!systems) return tl::unexpected(systems.error());
  auto kernels = options.kernel_names({"double", "plane"});
  if (!kernels) return tl::unexpected(kernels.error());
  plan.scenes = std::move(*scenes);
  plan.systems = std::move(*systems);
  plan.kernels = std::move(*kernels);
  plan.sizes = options.sizes;
  plan.seed = options.seed;
  plan.repeat = options.repeat;
  plan.certify_up_to = options.certify_up_to;
  plan.limits = options.limits();
  return plan;
}

/// With times: a page is looked at, and compared with no other byte for byte.
Expected<void> report_comparison(const comparison::Comparison& comparison,
                                 const CompareCommandOptions& options) {
  MeasuredRows measured;
  measured.command = "compare";
  measured.document = "comparison";
  for (const comparison::Row& row : comparison.rows) measured.rows.push_back(&row);
  measured.contradictions = comparison.contradictions;
  measured.interrupted = comparison.interrupted;
  measured.text = [&] {
    return comparison::comparison_text(comparison, {options.commands, options.counters});
  };
  measured.csv = [&] { return comparison::comparison_csv(comparison, true); };
  measured.json = [&](report::TextSink& sink) {
    comparison::write_comparison_json(sink, comparison, true);
  };
  return write_measured_report(options.report, measured);
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

  const auto written = options.write(
      comparison::comparison_text(*comparison, {options.commands, options.counters}),
      [&](report::TextSink& sink) {
        comparison::write_comparison_json(sink, *comparison, options.times);
      },
      [&] { return comparison::comparison_csv(*comparison, options.times); });
  if (!written) return report_error(written.error());
  if (options.report.asked()) {
    if (auto done = report_comparison(*comparison, options); !done) {
      return report_error(done.error());
    }
  }
  return status_of(comparison->interrupted, comparison->contradictions);
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
  add_comparison_options(command, *options, "double and plane");
  command.add_flag("--counters", options->counters, "Print all that each system counts");
  command.add_flag("--times", options->times,
                   "Seconds, ratios, memory and growth in JSON and CSV too");
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
