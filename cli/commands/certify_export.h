// SPDX-License-Identifier: GPL-3.0-or-later
// certify --export: the errors that were found, on the scene, for programs that show them.
#ifndef GNOMON_CLI_COMMANDS_CERTIFY_EXPORT_H
#define GNOMON_CLI_COMMANDS_CERTIFY_EXPORT_H

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/kernel/error.h"
#include "report/certificate/certificate.h"

namespace gnomon::cli {

void add_certify_export_option(CLI::App& command, std::vector<std::string>& files);
/// Errors: kUsage, for a file that is not called .vtp.
Expected<void> check_certify_exports(const std::vector<std::string>& files);
/// The exact answer with the errors of every run. Nothing of a run that was interrupted. Errors:
/// kFile, kInterrupted, kLimit.
Expected<void> write_certify_exports(const std::vector<std::string>& files,
                                     const LoadedScene& loaded,
                                     const report::Certificate& certificate);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CERTIFY_EXPORT_H
