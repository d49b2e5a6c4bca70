// SPDX-License-Identifier: GPL-3.0-or-later
// An algorithm as it is named on the command line: `auto`, `svbsp`, `sectors`.
#ifndef GNOMON_CLI_ALGORITHM_CHOICE_H
#define GNOMON_CLI_ALGORITHM_CHOICE_H

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

inline constexpr std::string_view kAutomaticName = "auto";
inline constexpr std::string_view kSvbspName = "svbsp";
inline constexpr std::string_view kSectorsName = "sectors";
inline constexpr std::string_view kReceiverName = "receiver";
/// For commands that take each of them.
inline constexpr std::string_view kBothName = "both";

/// --algorithm, into `name`.
CLI::Option* add_algorithm_option(CLI::App& command, std::string& name);

/// An option of the command line that only svbsp can serve, and whether it was given.
struct SvbspOption {
  std::string_view name;  // such as "--combined"
  bool given = false;
};

/// The name that parse_algorithm_choice() knows it by.
std::string_view name_of(Algorithm algorithm);

/// `auto` is sectors, or svbsp if one of `needs` was given. Errors: kUsage, for an unknown name
/// (`also`: what the command takes besides), and for sectors if one of `needs` was given.
Expected<Algorithm> parse_algorithm_choice(std::string_view name,
                                           std::initializer_list<SvbspOption> needs = {},
                                           std::string_view also = {});

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_ALGORITHM_CHOICE_H
