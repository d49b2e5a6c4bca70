// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/command_words.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "gnomon/algorithms/method.h"
#include "gnomon/kernel/kernel_list.h"

namespace gnomon::cli {

namespace {

/// Blanks in the place of line ends, as shells want it.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// "double|decimal" names all values; "FILE" and "x,y,z" name none.
std::vector<std::string> choices_in(std::string_view value) {
  std::vector<std::string> choices;
  if (value.find('|') == std::string_view::npos) return choices;
  while (true) {
    const std::size_t bar = value.find('|');
    const std::string_view word = value.substr(0, bar);
    const bool is_word = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
      return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
    });
    if (!is_word) return {};
    choices.emplace_back(word);
    if (bar == std::string_view::npos) return choices;
    value.remove_prefix(bar + 1);
  }
}

std::vector<std::string> kernel_choices() {
  std::vector<std::string> names{"exact"};
  for (const KernelInfo& kernel : kernel_list()) names.emplace_back(kernel.name);
  return names;
}

std::vector<std::string> method_choices() {
  std::vector<std::string> names{"auto"};
  for (const Method& method : methods()) {
    if (method.chosen_by_name) names.emplace_back(method.name);
  }
  return names;
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  words.summary = one_line(option.get_description());
  words.takes_value = option.get_items_expected_max() > 0 && option.get_type_size_max() > 0;
  words.may_repeat = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  if (!words.takes_value) return words;
  words.value = option.get_type_name();
  // CLI11 adds what validators say of themselves.
  words.value = words.value.substr(0, words.value.find(':'));
  words.choices = choices_in(words.value);
  if (option.check_lname("kernel")) words.choices = kernel_choices();
  if (option.check_lname("algorithm")) words.choices = method_choices();
  return words;
}

}  // namespace

std::vector<CommandWords> command_words(const CLI::App& app) {
  std::vector<CommandWords> all;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_group().empty()) continue;
    CommandWords words{command->get_name(), one_line(command->get_description()), {}};
    for (const CLI::Option* option : command->get_options()) {
      if (!option->nonpositional() || option->get_group().empty()) continue;
      words.options.push_back(words_of(*option));
    }
    all.push_back(std::move(words));
  }
  return all;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  return names;
}

const CLI::App* command_by_name(const CLI::App& app, const std::string& name) {
  const auto named = [&](const CLI::App* command) { return command->get_name() == name; };
  const auto found = app.get_subcommands(named);
  return found.empty() ? nullptr : found.front();
}

}  // namespace gnomon::cli
