// SPDX-License-Identifier: GPL-3.0-or-later
// What the commands that measure systems beside each other have in common: which scenes, systems
// and kernels, how often, within which limits, and where rows go.
#ifndef GNOMON_CLI_COMMANDS_COMPARISON_OPTIONS_H
#define GNOMON_CLI_COMMANDS_COMPARISON_OPTIONS_H

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "comparison/comparison.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

struct ComparisonOptions {
  std::vector<std::string> scenes, algorithms, kernels;
  std::vector<std::uint64_t> sizes;
  std::uint64_t seed = 1, repeat = 0, certify_up_to = comparison::kCertifyUpTo;
  std::string time;
  std::uint64_t megabytes = comparison::RunLimits{}.megabytes;
  bool commands = false;
  std::string json, csv;

  /// A folder is all scene files below it. Errors: of a scene that is none.
  Expected<std::vector<comparison::SceneSource>> sources() const;
  /// Empty: all that take the lights.
  Expected<std::vector<std::string>> systems() const;
  /// `usual`: where none is named.
  Expected<std::vector<std::string>> kernel_names(const std::vector<std::string>& usual) const;
  comparison::RunLimits limits() const;
};

/// The kernels that were built.
std::vector<std::string> all_kernels();

/// All but the scenes. `usual_kernels`, `usual_systems`: in words, for the help.
void add_run_options(CLI::App& command, ComparisonOptions& options,
                     const std::string& usual_kernels, const std::string& usual_systems);
void add_comparison_options(CLI::App& command, ComparisonOptions& options,
                            const std::string& usual_kernels);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_COMPARISON_OPTIONS_H
