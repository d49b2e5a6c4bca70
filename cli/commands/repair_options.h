// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `convert` that put a scene right, and the account of what they changed.
#ifndef GNOMON_CLI_COMMANDS_REPAIR_OPTIONS_H
#define GNOMON_CLI_COMMANDS_REPAIR_OPTIONS_H

#include <CLI/CLI.hpp>
#include <string>

#include "cli/common/scene_options.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

struct RepairOptions {
  std::string snap;  // a distance, as it was typed; empty: none
  bool parent = false, orient = false;
};

void add_repair_options(CLI::App& command, RepairOptions& options);

/// Does what was asked for, says what was changed, and notes it in the scene's "extra". Errors:
/// those of preparing the scene; kUsage for a distance that is none.
Expected<void> repair(SceneAsRead& read, const SceneOptions& source, const RepairOptions& options,
                      const std::string& target);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_REPAIR_OPTIONS_H
