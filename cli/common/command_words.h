// SPDX-License-Identifier: GPL-3.0-or-later
// What the command line's own description says of its words: commands, options, what they take.
#ifndef GNOMON_CLI_COMMON_COMMAND_WORDS_H
#define GNOMON_CLI_COMMON_COMMAND_WORDS_H

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gnomon::cli {

struct OptionWords {
  std::vector<std::string> names;  // as typed: "-o", "--output"
  std::string summary;             // one line
  bool takes_value = false;
  std::string value;                 // what help calls it: "FILE", "K", "double|decimal"
  std::vector<std::string> choices;  // all values that there are; none: any
  bool may_repeat = false;

  bool takes_file() const { return value.starts_with("FILE") || value == "RESULT"; }
  bool takes_directory() const { return value == "DIR"; }
};

struct CommandWords {
  std::string name, summary;
  std::vector<OptionWords> options;
};

/// The commands that are for people, in the order of help.
std::vector<CommandWords> command_words(const CLI::App& app);
/// Their names.
std::vector<std::string> command_names(const CLI::App& app);
/// Also one that is not for people; null if there is none.
const CLI::App* command_by_name(const CLI::App& app, const std::string& name);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_COMMAND_WORDS_H
