// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon tradeoff: speed against accuracy on one's own scenes (comparison/tradeoff.h).
#include "comparison/tradeoff.h"

#include <algorithm>
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
#include "comparison/scene_change.h"
#include "comparison/tradeoff_text.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

struct TradeoffOptions : ComparisonOptions {
  std::vector<double> thicknesses;
  std::vector<std::string> changes;
  bool thickness = false, invariances = false;
  std::string plot, log;
};

/// Rounded kernels, that of the scenes' own where only thicknesses are asked about, or all.
std::vector<std::string> usual_kernels(const TradeoffOptions& options) {
  return options.thickness ? std::vector<std::string>{"double"} : all_kernels();
}

Expected<comparison::TradeoffPlan> plan_of(const TradeoffOptions& options) {
  comparison::TradeoffPlan plan;
  auto scenes = options.sources();
  if (!scenes) return tl::unexpected(scenes.error());
  auto systems = options.systems();
  if (!systems) return tl::unexpected(systems.error());
  auto kernels = options.kernel_names(usual_kernels(options));
  if (!kernels) return tl::unexpected(kernels.error());
  plan.scenes = std::move(*scenes);
  plan.systems = std::move(*systems);
  plan.kernels = std::move(*kernels);
  plan.sizes = options.sizes;
  plan.seed = options.seed;
  plan.repeat = options.thickness && options.repeat == 0 ? 1 : options.repeat;
  plan.certify_up_to = options.certify_up_to;
  plan.limits = options.limits();
  plan.thicknesses = options.thicknesses;
  if (plan.thicknesses.empty() && !options.invariances) {
    plan.thicknesses = comparison::usual_thicknesses();
  }
  std::ranges::sort(plan.thicknesses);
  plan.changes = options.changes;
  for (const std::string& name : plan.changes) {
    if (comparison::change_by_name(name) != nullptr) continue;
    std::string names;
    for (const comparison::SceneChange& change : comparison::scene_changes()) {
      names += (names.empty() ? "" : ", ") + std::string(change.name);
    }
    return fail(ErrorCode::kUsage, "--change " + name + ": there is no such change", names);
  }
  if (options.invariances && plan.changes.empty()) {
    for (const comparison::SceneChange& change : comparison::scene_changes()) {
      plan.changes.emplace_back(change.name);
    }
  }
  if (!plan.changes.empty()) plan.certify_up_to = 0;
  return plan;
}

std::string text_of(const comparison::Tradeoff& tradeoff, const TradeoffOptions& options) {
  if (options.thickness) return comparison::thickness_text(tradeoff);
  if (options.invariances || !options.changes.empty()) return comparison::invariance_text(tradeoff);
  return comparison::tradeoff_text(tradeoff, options.commands);
}

Expected<void> report_tradeoff(const comparison::Tradeoff& tradeoff,
                               const TradeoffOptions& options) {
  MeasuredRows measured;
  measured.command = measured.document = "tradeoff";
  for (const comparison::TradeoffRow& row : tradeoff.rows) measured.rows.push_back(&row);
  measured.contradictions = tradeoff.contradictions;
  measured.interrupted = tradeoff.interrupted;
  measured.text = [&] { return text_of(tradeoff, options); };
  measured.csv = [&] { return comparison::tradeoff_csv(tradeoff); };
  measured.json = [&](report::TextSink& sink) { comparison::write_tradeoff_json(sink, tradeoff); };
  measured.plot = [&](report::TextSink& sink) { comparison::write_tradeoff_plot(sink, tradeoff); };
  return write_measured_report(options.report, measured);
}

int run_tradeoff(const TradeoffOptions& options) {
  const auto plan = plan_of(options);
  if (!plan) return report_error(plan.error());
  const auto program = own_program();
  if (!program) return report_error(program.error());
  auto log = open_log(options.log);
  if (!log) return report_error(log.error());
  ProgressLine line;
  comparison::CompareControl control;
  control.interrupted = &interrupted();
  control.progress = [&](const comparison::RunRequest& request, std::size_t done, std::size_t all) {
    line.show("tradeoff " + std::to_string(done) + " of " + std::to_string(all) + ": " +
              request.scene + ", " + request.kernel + '/' + request.system +
              (request.thickness ? ", thickness " + report::shortest(*request.thickness) : "") +
              (request.change.empty() ? "" : ", " + request.change));
  };
  const auto tradeoff = comparison::find_tradeoff(*plan, {*program, {"measure"}}, *log, control);
  line.clear();
  if (!tradeoff) return report_error(tradeoff.error());
  const auto written = options.write(
      text_of(*tradeoff, options),
      [&](report::TextSink& sink) { comparison::write_tradeoff_json(sink, *tradeoff); },
      [&] { return comparison::tradeoff_csv(*tradeoff); });
  if (!written) return report_error(written.error());
  const auto drawn = write_plot(options.plot, [&](report::TextSink& sink) {
    comparison::write_tradeoff_plot(sink, *tradeoff);
  });
  if (!drawn) return report_error(drawn.error());
  if (options.report.asked()) {
    if (auto done = report_tradeoff(*tradeoff, options); !done) return report_error(done.error());
  }
  return status_of(tradeoff->interrupted, tradeoff->contradictions);
}

}  // namespace

void add_tradeoff_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<TradeoffOptions>();
  CLI::App& command = *app.add_subcommand(
      "tradeoff", "Speed against accuracy: every kernel, thickness and method on your scenes");
  command.footer(
      "Each run is a process of its own on one thread; one that crashes or exceeds a limit is a\n"
      "row. Ends with 0 when all was measured, whatever failed.\n\n"
      "Examples:\n"
      "  gnomon tradeoff house.json --plot house.svg\n"
      "  gnomon tradeoff tests/regressions --thickness --algorithm sectors\n"
      "  gnomon tradeoff house.json --invariances --kernel double --kernel plane");
  add_comparison_options(command, *options, "all (with --thickness: double)");
  add_thickness_option(command, options->thicknesses,
                       "0 and\nthe powers of ten from 1e-15 to 1e-3");
  CLI::Option* const thickness =
      command.add_flag("--thickness", options->thickness,
                       "Print with which thicknesses each scene is right, and the best single one");
  command
      .add_flag("--invariances", options->invariances,
                "Print what changes that change no exact answer do to each kernel's")
      ->excludes(thickness);
  repeatable(command.add_option("--change", options->changes,
                                "Only this change of --invariances (repeatable)"))
      ->excludes(thickness)
      ->type_name("NAME");
  add_plot_option(command, options->plot, "Write time and error as a picture");
  add_log_option(command, options->log);
  command.callback([options, &action] { action = [options] { return run_tradeoff(*options); }; });
}

}  // namespace gnomon::cli
