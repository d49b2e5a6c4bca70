// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon certify: the options that candidates have that are tables, and what goes with what.
#ifndef GNOMON_CLI_COMMANDS_TABLE_OPTIONS_H
#define GNOMON_CLI_COMMANDS_TABLE_OPTIONS_H

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/commands/year_options.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

/// The options that only tables have, and those of the command that they do not go with.
class TableOptionRules {
 public:
  /// Adds the options of suns. `command`: with all others but those of --corpus.
  void add(CLI::App& command, YearOptions& options);

  bool sun_at_given() const { return sun_at_->count() > 0; }
  /// `tables`: of so many candidates. Errors: kUsage.
  Expected<void> check(std::size_t tables, std::size_t candidates) const;
  /// For a table that has its own suns. Errors: kUsage.
  Expected<void> check_own_suns(const std::string& table) const;

 private:
  std::vector<const CLI::Option*> excluded_, suns_;
  const CLI::Option* sun_at_ = nullptr;
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_TABLE_OPTIONS_H
