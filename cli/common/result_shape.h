// SPDX-License-Identifier: GPL-3.0-or-later
// What a command that writes a result was asked to put into it: the options, what a run must keep
// for them, and what the file then holds.
#ifndef GNOMON_CLI_COMMON_RESULT_SHAPE_H
#define GNOMON_CLI_COMMON_RESULT_SHAPE_H

#include <CLI/CLI.hpp>
#include <string>

#include "cli/common/algorithm_choice.h"
#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/kernel_choice.h"
#include "report/json/result_json.h"

namespace gnomon::cli {

struct ResultShape {
  bool fragments = false, exact_fractions = false, exact_loops = false, combined = false;
};

/// --fragments, --exact-fractions and --exact-loops.
void add_shape_options(CLI::App& command, ResultShape& shape);

/// That an option needs an exact kernel, and this one rounds.
tl::unexpected<Error> needs_exact_kernel(const std::string& option, const std::string& kernel);
/// Errors: kUsage, for what is asked of a kernel that rounds.
Expected<void> check_exactness(const ResultShape& shape, const KernelChoice& kernel);

/// Keeps what the result will hold.
void keep_for(const ResultShape& shape, ShadowOutput& output);
/// How the result is written: as of this scene, by this method.
report::ResultJsonOptions result_json_options(const ResultShape& shape, const LoadedScene& loaded,
                                              const AlgorithmChoice& algorithm);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_RESULT_SHAPE_H
