// SPDX-License-Identifier: GPL-3.0-or-later
// Methods as commands of pictures name them: those of image space, and those of object space whose
// fragments are sampled.
#ifndef GNOMON_CLI_COMMON_PIXEL_METHOD_H
#define GNOMON_CLI_COMMON_PIXEL_METHOD_H

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/method_options.h"

namespace gnomon::cli {

/// --algorithm, into `name`.
CLI::Option* add_pixel_algorithm_option(CLI::App& command, std::string& name);

/// NAME[:option=value,...] of either domain. Errors: kUsage: no such method, one that makes no
/// fragments or takes no point lights, no such option, a value that it does not take.
Expected<MethodSelection> parse_pixel_method(std::string_view text);

/// All that can be sampled, with the options' defaults; those of image space first.
std::vector<MethodSelection> all_pixel_methods();

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_PIXEL_METHOD_H
