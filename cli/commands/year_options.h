// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon year: its options as typed, and what they mean for a scene.
#ifndef GNOMON_CLI_COMMANDS_YEAR_OPTIONS_H
#define GNOMON_CLI_COMMANDS_YEAR_OPTIONS_H

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/report_output.h"
#include "cli/common/scene_options.h"
#include "gnomon/kernel/error.h"
#include "suns/year/asked_suns.h"

namespace gnomon::cli {

struct YearOptions : suns::AskedSuns {
  SceneOptions scene;
  std::string kernel{"plane"}, algorithm{"auto"};
  // What is written.
  std::string output, shading, hours;
  std::string database, shard;
  std::vector<std::string> merge;
  ReportOptions report;
  bool gross = false, stats = false;
  int digits = 7;

  bool writes_tables() const {
    return !output.empty() || !shading.empty() || !hours.empty() || report.asked();
  }
};

void add_year_options(CLI::App& command, YearOptions& options);
/// Those alone that say which suns: place, model, year, and where in its step the sun is looked at.
void add_sun_options(CLI::App& command, YearOptions& options);

/// Every n-th row from the k-th on.
struct YearShard {
  std::size_t index = 0, count = 1;
  bool has(std::size_t row) const { return row % count == index; }
};
/// Errors: kUsage.
Expected<YearShard> parse_year_shard(const std::string& text);

/// What does not go together, whatever the scene is. Errors: kUsage.
Expected<void> check_year_options(const YearOptions& options);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_YEAR_OPTIONS_H
