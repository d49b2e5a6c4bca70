// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/table_options.h"

#include <algorithm>

namespace gnomon::cli {

void TableOptionRules::add(CLI::App& command, YearOptions& options) {
  const std::vector<std::string> common = {
      "--help", "--help-all",  "SCENE",      "--candidate", "--tolerance", "--json",   "--numbers",
      "--jobs", "--two-sided", "--skip-bad", "--lod",       "--subset",    "--report", "--junit"};
  const std::vector<CLI::Option*> others = command.get_options();
  for (const CLI::Option* other : others) {
    const bool is_common = std::ranges::any_of(
        common, [&](const std::string& name) { return other->check_name(name); });
    if (!is_common) excluded_.push_back(other);
  }
  add_sun_options(command, options);
  for (CLI::Option* option : command.get_options()) {
    if (std::ranges::count(others, option) > 0) continue;
    option->group("Suns of a candidate that is a table");
    suns_.push_back(option);
    if (option->check_name("--sun-at")) {
      option->description("Where in its step the sun is looked at")
          ->default_str("middle of an hour, else end");
      sun_at_ = option;
    }
  }
}

Expected<void> TableOptionRules::check(std::size_t tables, std::size_t candidates) const {
  if (tables > 0 && tables < candidates) {
    return fail(ErrorCode::kUsage, "tables and results are not judged together",
                "--candidate of one kind");
  }
  for (const CLI::Option* option : tables > 0 ? excluded_ : suns_) {
    if (option->count() == 0) continue;
    return tables > 0 ? fail(ErrorCode::kUsage,
                             option->get_name() + " does not go with a candidate that is a table")
                      : fail(ErrorCode::kUsage, option->get_name() + " is of tables alone",
                             "--candidate FILE.csv");
  }
  return {};
}

Expected<void> TableOptionRules::check_own_suns(const std::string& table) const {
  for (const CLI::Option* option : suns_) {
    if (option->count() == 0) continue;
    return fail(ErrorCode::kUsage, option->get_name() + ": " + table + " has its own suns",
                "no options of suns");
  }
  return {};
}

}  // namespace gnomon::cli
