// SPDX-License-Identifier: GPL-3.0-or-later
// shadows --shares: the table of shares, written while lights are classified. What is interrupted
// leaves the table of the lights that were done.
#ifndef GNOMON_CLI_COMMANDS_SHARE_OUTPUT_H
#define GNOMON_CLI_COMMANDS_SHARE_OUTPUT_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/kernel_list.h"
#include "report/shares/share_table.h"
#include "scene/base/output_file.h"

namespace gnomon::cli {

class ShareOutput {
 public:
  /// Keeps a reference to the scene. Errors: kUsage for an ending that names no format; kFile.
  static Expected<ShareOutput> open(const std::filesystem::path& file, const LoadedScene& loaded,
                                    KernelId kernel);

  /// Writes the row of the next light. False once a row could not be written.
  bool add(const LightResult& light);
  /// Puts the table in its place, and the names of rows and columns beside it where the format has
  /// no room for them. Errors: kFile, also for whatever failed before; kInterrupted, with the
  /// number of rows that are there, if lights are missing (without any row no table either).
  Expected<void> finish();

 private:
  ShareOutput(std::filesystem::path file, const LoadedScene& loaded, OutputFile output,
              KernelId kernel, report::ShareFormat format)
      : file_(std::move(file)),
        loaded_(&loaded),
        kernel_(kernel),
        format_(format),
        table_(loaded.scene, loaded.prepared, loaded.lights, format),
        output_(std::move(output)) {}

  std::filesystem::path file_;
  const LoadedScene* loaded_;
  KernelId kernel_;
  report::ShareFormat format_;
  report::ShareTable table_;
  OutputFile output_;
  std::size_t lights_ = 0;
  std::optional<Error> failure_;  // the first
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_SHARE_OUTPUT_H
