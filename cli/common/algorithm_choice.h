// SPDX-License-Identifier: GPL-3.0-or-later
// Algorithms as they are named on the command line: `sectors` and `svbsp` for point and directional
// lights, `receiver` and `merged` for area lights, `auto`, `both`.
#ifndef GNOMON_CLI_COMMON_ALGORITHM_CHOICE_H
#define GNOMON_CLI_COMMON_ALGORITHM_CHOICE_H

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

inline constexpr std::string_view kAutomaticName = "auto";
/// For commands that take each of them.
inline constexpr std::string_view kBothName = "both";

/// --algorithm, into `name`.
CLI::Option* add_algorithm_option(CLI::App& command, std::string& name);

/// An option of the command line that only some algorithms can serve, and whether it was given.
struct NeedyOption {
  std::string_view name;  // such as "--combined"
  bool given = false;
  bool receiver_can = false;  // svbsp can anyhow
};

struct AlgorithmChoice {
  Algorithm point = Algorithm::kSectors;  // for point and directional lights
  AreaAlgorithm area = AreaAlgorithm::kReceiver;

  /// Such as "sectors", "merged" or "sectors+receiver", by the lights that there are.
  std::string name(const LoadedScene& loaded) const;
  friend bool operator==(const AlgorithmChoice&, const AlgorithmChoice&) = default;
};

/// `auto` is sectors and receiver; where one of `needs` was given svbsp stands for sectors, unless
/// `sectors` was asked for by name. Errors: kUsage, for an unknown name (`also`: what the command
/// takes besides), and for an algorithm that cannot do what was asked.
Expected<AlgorithmChoice> parse_algorithm_choice(std::string_view name,
                                                 std::initializer_list<NeedyOption> needs = {},
                                                 std::string_view also = {});

/// What `both` stands for: sectors and receiver, then svbsp and merged.
std::vector<AlgorithmChoice> both_algorithms();

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_ALGORITHM_CHOICE_H
