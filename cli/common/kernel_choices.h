// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels that a command runs beside each other: those that were named, or those that suit the
// size of the scene.
#ifndef GNOMON_CLI_COMMON_KERNEL_CHOICES_H
#define GNOMON_CLI_COMMON_KERNEL_CHOICES_H

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/kernel/kernel_choice.h"

namespace gnomon::cli {

/// --kernel of a command that runs several, into `names`.
CLI::Option* add_kernels_option(CLI::App& command, std::vector<std::string>& names);

/// Those named, once each; `all` stands for every kernel under the policies of the default set.
/// Nothing named: the default set for a scene of so many parts. Kernels that were not built are
/// left out. Errors: kUsage, for an unknown name.
Expected<std::vector<KernelChoice>> chosen_kernels(const std::vector<std::string>& names,
                                                   std::size_t parts);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_KERNEL_CHOICES_H
