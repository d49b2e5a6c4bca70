// SPDX-License-Identifier: GPL-3.0-or-later
// The options that say what is under test and what is demanded of it: shared by `fuzz`, `replay`,
// `shrink` and the processes that they start.
#ifndef GNOMON_CLI_COMMON_CHECK_OPTIONS_H
#define GNOMON_CLI_COMMON_CHECK_OPTIONS_H

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/workers/worker.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

struct CheckCommandOptions {
  std::vector<std::string> kernels, commands, properties;
  std::optional<double> tolerance;
  std::optional<double> width;
  bool strict = false, in_turn = false;
  std::uint64_t fragments = 200'000;
  double seconds = 10;
  std::uint64_t megabytes = 2048;
};

void add_check_options(CLI::App& command, CheckCommandOptions& options);

/// Subjects are what was named; `standard` where nothing was. Errors: kUsage, for unknown names.
Expected<fuzz::WorkerOptions> worker_options(const CheckCommandOptions& options,
                                             std::vector<fuzz::Subject> standard);

/// This program's own file, to start it again. Errors: kFile.
Expected<std::string> own_program();

/// Seconds from "90", "90s", "5m", "2h"; for CLI options.
CLI::Validator duration();
double duration_seconds(const std::string& text);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_CHECK_OPTIONS_H
