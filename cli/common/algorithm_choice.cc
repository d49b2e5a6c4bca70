// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/algorithm_choice.h"

#include <algorithm>

namespace gnomon::cli {

namespace {

constexpr std::string_view kSvbspName = "svbsp";
constexpr std::string_view kSectorsName = "sectors";
constexpr std::string_view kReceiverName = "receiver";
constexpr std::string_view kMergedName = "merged";
constexpr std::string_view kPiecesName = "pieces";

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

std::string_view name_of(AreaAlgorithm algorithm) {
  switch (algorithm) {
    case AreaAlgorithm::kReceiver:
      return kReceiverName;
    case AreaAlgorithm::kMerged:
      return kMergedName;
    case AreaAlgorithm::kPieces:
      return kPiecesName;
  }
  return {};
}

}  // namespace

CLI::Option* add_algorithm_option(CLI::App& command, std::string& name) {
  return command
      .add_option("--algorithm", name,
                  "How shadows are found. Point and directional lights: sectors (needs no order)\n"
                  "or svbsp (front to back by a scene BSP); area lights: receiver (each polygon\n"
                  "against its casters; point lights too) or merged (two trees of all casters);\n"
                  "auto: sectors and receiver wherever they can do what is asked")
      ->type_name("A")
      ->default_str(std::string(kAutomaticName));
}

std::string AlgorithmChoice::name(const LoadedScene& loaded) const {
  std::string name;
  const auto has = [&](bool area) {
    return std::ranges::any_of(loaded.lights, [&](std::uint32_t light) {
      return (loaded.scene.lights[light].type == LightType::kArea) == area;
    });
  };
  if (has(false)) name = name_of(point);
  if (has(true) && name_of(area) != name)
    name += (name.empty() ? "" : "+") + std::string(name_of(area));
  return name;
}

Expected<AlgorithmChoice> parse_algorithm_choice(std::string_view name,
                                                 std::initializer_list<NeedyOption> needs,
                                                 std::string_view also) {
  const auto need = std::ranges::find(needs, true, &NeedyOption::given);
  const Algorithm point = need == needs.end() ? Algorithm::kSectors : Algorithm::kSvbsp;
  if (name == kSvbspName) return AlgorithmChoice{.point = Algorithm::kSvbsp};
  if (name == kAutomaticName) return AlgorithmChoice{.point = point};
  if (name == kMergedName) return AlgorithmChoice{.point = point, .area = AreaAlgorithm::kMerged};
  if (name != kSectorsName && name != kReceiverName) {
    std::string names("one of: ");
    for (const std::string_view known :
         {kAutomaticName, kSectorsName, kSvbspName, kReceiverName, kMergedName, also}) {
      if (!known.empty()) names += (known == kAutomaticName ? "" : ", ") + std::string(known);
    }
    return fail(ErrorCode::kUsage, "--algorithm " + std::string(name) + ": no such algorithm",
                std::move(names));
  }
  const bool receiver = name == kReceiverName;
  for (const NeedyOption& option : needs) {
    if (!option.given || (receiver && option.receiver_can)) continue;
    return fail(ErrorCode::kUsage,
                std::string(option.name) + " needs svbsp, not " + std::string(name),
                "--algorithm svbsp, or auto");
  }
  return AlgorithmChoice{.point = receiver ? Algorithm::kReceiver : Algorithm::kSectors};
}

std::vector<AlgorithmChoice> both_algorithms() {
  return {{.point = Algorithm::kSectors, .area = AreaAlgorithm::kReceiver},
          {.point = Algorithm::kSvbsp, .area = AreaAlgorithm::kMerged}};
}

}  // namespace gnomon::cli
