// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithm_choice.h"

#include <algorithm>

namespace gnomon::cli {

CLI::Option* add_algorithm_option(CLI::App& command, std::string& name) {
  return command
      .add_option("--algorithm", name,
                  "How shadows are found: sectors (needs no order), svbsp (front to back by a\n"
                  "scene BSP), or auto: sectors wherever it can do what is asked")
      ->type_name("A")
      ->default_str(std::string(kAutomaticName));
}

std::string_view name_of(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::kAutomatic:
      return kAutomaticName;
    case Algorithm::kSvbsp:
      return kSvbspName;
    case Algorithm::kSectors:
      return kSectorsName;
    case Algorithm::kReceiver:
      return kReceiverName;
  }
  return {};
}

Expected<Algorithm> parse_algorithm_choice(std::string_view name,
                                           std::initializer_list<SvbspOption> needs,
                                           std::string_view also) {
  const auto need = std::ranges::find(needs, true, &SvbspOption::given);
  if (name == kSvbspName) return Algorithm::kSvbsp;
  if (name == kAutomaticName) return need == needs.end() ? Algorithm::kSectors : Algorithm::kSvbsp;
  if (name != kSectorsName) {
    std::string names("one of: ");
    for (const std::string_view known : {kAutomaticName, kSectorsName, kSvbspName, also}) {
      if (!known.empty()) names += (known == kAutomaticName ? "" : ", ") + std::string(known);
    }
    return fail(ErrorCode::kUsage, "--algorithm " + std::string(name) + ": no such algorithm",
                std::move(names));
  }
  if (need != needs.end()) {
    return fail(ErrorCode::kUsage, std::string(need->name) + " needs svbsp, not sectors",
                "--algorithm svbsp, or auto");
  }
  return Algorithm::kSectors;
}

}  // namespace gnomon::cli
