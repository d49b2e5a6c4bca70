// SPDX-License-Identifier: GPL-3.0-or-later
// The option of `gnomon shadows` that writes the result as files of other programs.
#ifndef GNOMON_CLI_COMMANDS_EXPORTS_H
#define GNOMON_CLI_COMMANDS_EXPORTS_H

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

struct ExportOptions {
  std::vector<std::string> files;

  /// Then the run has to keep fragments with points.
  bool given() const { return !files.empty(); }
};

void add_export_option(CLI::App& command, ExportOptions& options);
/// Errors: kUsage, for a file whose name tells no format.
Expected<void> check_exports(const ExportOptions& options);
/// Errors: those of report::write_export(); kFile.
Expected<void> write_exports(const ExportOptions& options, const LoadedScene& loaded,
                             const ShadowResult& result);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_EXPORTS_H
