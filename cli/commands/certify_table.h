// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon certify --candidate FILE.csv: tables of shares that engines wrote, judged under their own
// suns.
#ifndef GNOMON_CLI_COMMANDS_CERTIFY_TABLE_H
#define GNOMON_CLI_COMMANDS_CERTIFY_TABLE_H

#include <optional>
#include <string>
#include <vector>

#include "cli/commands/table_options.h"
#include "cli/commands/year_options.h"
#include "cli/common/report_output.h"
#include "cli/common/scene_options.h"

namespace gnomon::cli {

struct TableCommandOptions {
  SceneOptions scene;
  YearOptions suns;
  std::vector<std::string> tables;
  std::optional<double> tolerance;
  std::string json;
  ReportOptions report;
};

/// The exit status.
int run_certify_tables(const TableCommandOptions& options, const TableOptionRules& rules);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CERTIFY_TABLE_H
