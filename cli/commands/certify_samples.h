// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon certify --samples FILE: points of any program with what was seen there, each decided
// exactly.
#ifndef GNOMON_CLI_COMMANDS_CERTIFY_SAMPLES_H
#define GNOMON_CLI_COMMANDS_CERTIFY_SAMPLES_H

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

struct SampleCommandOptions {
  SceneOptions scene;
  std::vector<std::string> files;
  std::optional<double> tolerance, width;
  double clearance = 0;
  bool strict = false;
  std::size_t misses = 10;
  std::string json;
};

/// The options that samples have, and those of the command that they do not go with.
class SampleOptionRules {
 public:
  /// Adds --samples and --misses. `command`: with all others but those of --corpus and of tables.
  void add(CLI::App& command, std::vector<std::string>& files, std::size_t& misses);
  /// `samples`: of so many candidates, those of --samples included. Errors: kUsage.
  Expected<void> check(std::size_t samples, std::size_t candidates) const;

 private:
  std::vector<const CLI::Option*> excluded_;
  const CLI::Option* misses_ = nullptr;
};

/// The exit status.
int run_certify_samples(const SampleCommandOptions& options);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CERTIFY_SAMPLES_H
