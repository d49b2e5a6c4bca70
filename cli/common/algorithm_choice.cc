// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/algorithm_choice.h"

#include <algorithm>
#include <utility>

#include "gnomon/kernel/kernel_choice.h"

namespace gnomon::cli {

namespace {

/// "sectors (needs no order), svbsp (...)": the methods for lights of one kind, for a help text.
std::string described(LightKinds lights) {
  std::string text;
  for (const Method& method : methods()) {
    const bool takes = (lights.point && method.lights.point) || (lights.area && method.lights.area);
    if (!method.chosen_by_name || !takes) continue;
    text += (text.empty() ? "" : ",\n  ") + std::string(method.name) + " (" +
            std::string(method.summary) + ")";
  }
  return text;
}

bool can_serve(const Method& method, std::initializer_list<NeedyOption> needs) {
  return std::ranges::all_of(
      needs, [&](const NeedyOption& option) { return !option.given || method.*option.ability; });
}

/// The method that `auto` takes for point and directional lights: the first that can do all that is
/// needed.
MethodId automatic_method(std::initializer_list<NeedyOption> needs) {
  for (const Method& method : methods()) {
    if (method.lights.point && can_serve(method, needs)) return method.id;
  }
  return MethodId::kSectors;
}

}  // namespace

CLI::Option* add_kernel_option(CLI::App& command, std::string& name) {
  return command
      .add_option("--kernel", name,
                  kernel_names(", ") +
                      ", or exact (= " + std::string(kernel_info(kDefaultExactKernel).name) + ")")
      ->type_name("K")
      ->capture_default_str();
}

CLI::Option* add_algorithm_option(CLI::App& command, std::string& name, std::string_view question,
                                  std::string_view besides) {
  std::string text(question);
  text += "\nPoint and directional lights: " + described({.point = true});
  text += ";\narea lights: " + described({.area = true}) +
          ";\noptions as in tiling:tiles=64,cover=overlay (gnomon systems lists them);\n";
  return command.add_option("--algorithm", name, text + std::string(besides))
      ->type_name("A")
      ->default_str(std::string(kAutomaticName));
}

std::string AlgorithmChoice::name(const LoadedScene& loaded) const {
  std::string name;
  const auto has = [&](bool area) {
    return std::ranges::any_of(loaded.lights, [&](std::uint32_t light) {
      return loaded.scene.lights[light].has_area() == area;
    });
  };
  if (has(false)) name = method_text(point, options);
  const std::string area_name = method_text(area, options);
  if (has(true) && area_name != name) name += (name.empty() ? "" : "+") + area_name;
  return name;
}

Expected<AlgorithmChoice> parse_algorithm_choice(std::string_view name,
                                                 std::initializer_list<NeedyOption> needs,
                                                 std::string_view also) {
  AlgorithmChoice choice{.point = automatic_method(needs)};
  if (name == kAutomaticName) return choice;
  if (name.substr(0, name.find(':')) == kAutomaticName) {
    return fail(ErrorCode::kUsage, "--algorithm " + std::string(name) + ": auto has no options",
                "an algorithm by its name");
  }
  auto selection = parse_method(name);
  if (!selection) {
    Error error = std::move(selection.error());
    error.what = "--algorithm " + error.what;
    if (!method_by_name(name.substr(0, name.find(':')))) {
      error.expected += ", " + std::string(kAutomaticName);
      if (!also.empty()) error.expected += ", " + std::string(also);
    }
    return tl::unexpected(std::move(error));
  }
  choice.options = selection->values;
  const Method& method = method_info(selection->id);
  if (!method.lights.point) {
    choice.area = selection->id;
    return choice;
  }
  for (const NeedyOption& option : needs) {
    if (!option.given || method.*option.ability) continue;
    const std::string able(method_info(automatic_method({option})).name);
    const bool receiver_can = method_info(MethodId::kReceiver).*option.ability;
    const std::string of_area =
        method.lights.area && receiver_can ? " (area lights: receiver)" : "";
    return fail(
        ErrorCode::kUsage,
        std::string(option.name) + " needs " + able + of_area + ", not " + std::string(method.name),
        "--algorithm " + able + ", or auto");
  }
  choice.point = selection->id;
  if (method.lights.area) choice.area = selection->id;
  return choice;
}

namespace {

/// What `both` and `all` stand for, whatever the methods can do.
std::vector<AlgorithmChoice> choices_named(std::string_view name) {
  if (name == kBothName) {
    return {{.point = MethodId::kSectors, .area = MethodId::kReceiver},
            {.point = MethodId::kSvbsp, .area = MethodId::kMerged}};
  }
  if (name != kAllName) return {};
  // Each method for point lights beside one for area lights, itself where it takes them, until
  // every method has been in a pair.
  std::vector<MethodId> area;
  for (const Method& method : methods()) {
    if (method.chosen_by_name && method.lights.area) area.push_back(method.id);
  }
  std::vector<AlgorithmChoice> choices;
  for (const Method& method : methods()) {
    if (!method.chosen_by_name || !method.lights.point) continue;
    const std::size_t next = std::min(choices.size(), area.size() - 1);
    choices.push_back({.point = method.id, .area = method.lights.area ? method.id : area[next]});
  }
  for (std::size_t i = choices.size(); i < area.size(); ++i) choices.push_back({.area = area[i]});
  return choices;
}

}  // namespace

std::vector<AlgorithmChoice> several_algorithms(std::string_view name,
                                                std::initializer_list<NeedyOption> needs) {
  std::vector<AlgorithmChoice> choices = choices_named(name);
  for (AlgorithmChoice& choice : choices) {
    if (!can_serve(method_info(choice.point), needs)) choice.point = automatic_method(needs);
  }
  return choices;
}

std::string methods_that(bool Method::*ability) {
  std::string names;
  for (const Method& method : methods()) {
    if (!method.chosen_by_name || !(method.*ability)) continue;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  return names;
}

void drop_repeats(std::vector<AlgorithmChoice>& choices, const LoadedScene& loaded) {
  const bool has_region = std::ranges::any_of(loaded.lights, [&](std::uint32_t light) {
    return !loaded.prepared.lights[light].region.empty();
  });
  std::vector<std::string> names;
  std::erase_if(choices, [&](const AlgorithmChoice& choice) {
    if (has_region && choices.size() > 1 && choice.point == MethodId::kContour) return true;
    const std::string name = choice.name(loaded);
    if (std::ranges::count(names, name) > 0) return true;
    names.push_back(name);
    return false;
  });
}

}  // namespace gnomon::cli
