// SPDX-License-Identifier: GPL-3.0-or-later
// What the commands that measure systems beside each other have in common: which scenes, systems
// and kernels, how often, within which limits, and where rows go.
#ifndef GNOMON_CLI_COMMANDS_COMPARISON_OPTIONS_H
#define GNOMON_CLI_COMMANDS_COMPARISON_OPTIONS_H

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/common/exit_status.h"
#include "cli/common/report_output.h"
#include "comparison/comparison.h"
#include "comparison/run_log.h"
#include "gnomon/kernel/error.h"
#include "report/text/text_sink.h"

namespace gnomon::cli {

struct ComparisonOptions {
  std::vector<std::string> scenes, algorithms, kernels;
  std::vector<std::uint64_t> sizes;
  std::uint64_t seed = 1, repeat = 0, certify_up_to = comparison::kCertifyUpTo;
  std::string time;
  std::uint64_t megabytes = comparison::RunLimits{}.megabytes;
  bool commands = false;
  std::string json, csv;
  ReportOptions report;

  /// A folder is all scene files below it. Errors: of a scene that is none.
  Expected<std::vector<comparison::SceneSource>> sources() const;
  /// Empty: all that take the lights.
  Expected<std::vector<std::string>> systems() const;
  /// `usual`: where none is named.
  Expected<std::vector<std::string>> kernel_names(const std::vector<std::string>& usual) const;
  comparison::RunLimits limits() const;
  /// The text on standard output, unless JSON or CSV go there alone; JSON and CSV where they were
  /// asked for.
  Expected<void> write(const std::string& text,
                       const std::function<void(report::TextSink&)>& write_json,
                       const std::function<std::string()>& csv) const;
};

/// What ends a command that measures: interrupted, contradicted by an exact kernel, or done.
ExitStatus status_of(bool interrupted, const std::vector<std::string>& contradictions);
/// One that keeps nothing if no file is named.
Expected<comparison::RunLog> open_log(const std::string& file);
void add_log_option(CLI::App& command, std::string& file);
/// `--plot FILE.svg`, written by write_plot() if it was given.
void add_plot_option(CLI::App& command, std::string& file, const std::string& what);
Expected<void> write_plot(const std::string& file,
                          const std::function<void(report::TextSink&)>& draw);
/// `--try T`; `absent`: what is tried else, in words.
void add_thickness_option(CLI::App& command, std::vector<double>& thicknesses,
                          const std::string& absent);

/// The kernels that were built.
std::vector<std::string> all_kernels();

/// All but the scenes. `usual_kernels`, `usual_systems`: in words, for the help.
void add_run_options(CLI::App& command, ComparisonOptions& options,
                     const std::string& usual_kernels, const std::string& usual_systems);
void add_comparison_options(CLI::App& command, ComparisonOptions& options,
                            const std::string& usual_kernels);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_COMPARISON_OPTIONS_H
