// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon extremes: where each kernel begins to fail (comparison/extremes.h).
#include "comparison/extremes.h"

#include <algorithm>
#include <memory>
#include <optional>
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
#include "comparison/extremes_text.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

struct ExtremesOptions : ComparisonOptions {
  std::vector<std::string> axes;
  std::vector<double> thicknesses;
  std::optional<int> from, to, steps;
  bool sheared = false, bisect = false, list = false, curves = false;
  std::string plot, log;
};

Expected<comparison::ExtremesPlan> plan_of(const ExtremesOptions& options) {
  comparison::ExtremesPlan plan;
  for (const std::string& name : options.axes) {
    const comparison::ExtremeAxis* const axis = comparison::axis_by_name(name);
    if (axis == nullptr) {
      std::string names;
      for (const comparison::ExtremeAxis& each : comparison::extreme_axes()) {
        names += (names.empty() ? "" : " ") + std::string(each.name);
      }
      return fail(ErrorCode::kUsage, "there is no axis '" + name + "'", names);
    }
    if (std::ranges::find(plan.axes, axis) == plan.axes.end()) plan.axes.push_back(axis);
  }
  if (plan.axes.empty()) {
    for (const comparison::ExtremeAxis& axis : comparison::extreme_axes()) {
      plan.axes.push_back(&axis);
    }
  }
  auto systems = options.systems();
  if (!systems) return tl::unexpected(systems.error());
  auto kernels =
      options.kernel_names({"float", "double", "double+identity", "longdouble", "epick", "plane"});
  if (!kernels) return tl::unexpected(kernels.error());
  plan.runs.systems = options.algorithms.empty()
                          ? std::vector<std::string>{"sectors", "svbsp", "receiver", "merged"}
                          : std::move(*systems);
  plan.runs.kernels = std::move(*kernels);
  plan.runs.thicknesses = options.thicknesses;
  plan.runs.repeat = options.repeat;
  plan.runs.certify_up_to = options.certify_up_to;
  plan.runs.limits = options.limits();
  plan.from = options.from;
  plan.to = options.to;
  plan.steps = options.steps;
  plan.sheared = options.sheared;
  plan.bisect = options.bisect;
  return plan;
}

Expected<void> report_extremes(const comparison::Extremes& extremes,
                               const ExtremesOptions& options) {
  MeasuredRows measured;
  measured.command = measured.document = "extremes";
  for (const comparison::TradeoffRow& row : extremes.runs.rows) measured.rows.push_back(&row);
  const comparison::ExtremeAxis* last = nullptr;  // curves are in the order of axes
  for (const comparison::ExtremeCurve& curve : extremes.curves) {
    if (curve.axis == last) continue;
    last = curve.axis;
    measured.title += (measured.title.empty() ? "" : ", ") + std::string(last->name);
  }
  measured.contradictions = extremes.runs.contradictions;
  measured.interrupted = extremes.runs.interrupted;
  measured.text = [&] { return comparison::extremes_text(extremes, options.curves); };
  measured.csv = [&] { return comparison::extremes_csv(extremes); };
  measured.json = [&](report::TextSink& sink) { comparison::write_extremes_json(sink, extremes); };
  measured.plot = [&](report::TextSink& sink) { comparison::write_extremes_plot(sink, extremes); };
  return write_measured_report(options.report, measured);
}

int run_extremes(const ExtremesOptions& options) {
  if (options.list) {
    const auto done = write_output({}, comparison::extreme_axes_text());
    return done ? kDone : report_error(done.error());
  }
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
    line.show("extremes " + std::to_string(done) + " of " + std::to_string(all) + ": " +
              request.scene + ", " + request.kernel + '/' + request.system);
  };
  const auto extremes = comparison::find_extremes(*plan, {*program, {"measure"}}, *log, control);
  line.clear();
  if (!extremes) return report_error(extremes.error());
  const auto written = options.write(
      comparison::extremes_text(*extremes, options.curves),
      [&](report::TextSink& sink) { comparison::write_extremes_json(sink, *extremes); },
      [&] { return comparison::extremes_csv(*extremes); });
  if (!written) return report_error(written.error());
  const auto drawn = write_plot(options.plot, [&](report::TextSink& sink) {
    comparison::write_extremes_plot(sink, *extremes);
  });
  if (!drawn) return report_error(drawn.error());
  if (options.report.asked()) {
    if (auto done = report_extremes(*extremes, options); !done) return report_error(done.error());
  }
  return status_of(extremes->runs.interrupted, extremes->runs.contradictions);
}

}  // namespace

void add_extremes_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExtremesOptions>();
  CLI::App& command = *app.add_subcommand(
      "extremes", "Where each kernel begins to fail: families of scenes from easy to hopeless");
  command.footer(
      "Each run is a process of its own on one thread, judged by the oracle. Ends with 0 when all\n"
      "was measured, whatever failed.\n\n"
      "Examples:\n"
      "  gnomon extremes --list\n"
      "  gnomon extremes offset gap --kernel double --kernel plane --curves\n"
      "  gnomon extremes offset --algorithm sectors --bisect --log offset.log");
  command.add_option("AXIS", options->axes, "Axes of difficulty; absent: all")
      ->type_name("AXIS...");
  command.add_flag("--list", options->list, "List the axes and their steps");
  command.add_option("--from", options->from, "First step of each axis")->type_name("K");
  command.add_option("--to", options->to, "Last step of each axis")->type_name("K");
  command.add_option("--steps", options->steps, "So many steps, evenly")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command.add_flag("--bisect", options->bisect, "Find the exact step at which each begins to fail");
  command.add_flag("--sheared", options->sheared,
                   "Under an exact map of space that keeps no plane parallel to an axis");
  command.add_flag("--curves", options->curves, "Print the worst share of every step");
  add_thickness_option(command, options->thicknesses, "1e-12");
  add_plot_option(command, options->plot, "Write the worst share of every step as a picture");
  add_log_option(command, options->log);
  add_run_options(command, *options, "float, double, double+identity, longdouble, epick and plane",
                  "sectors, svbsp, receiver, merged");
  command.callback([options, &action] { action = [options] { return run_extremes(*options); }; });
}

}  // namespace gnomon::cli
