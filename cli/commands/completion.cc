// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon completion: what a shell needs to complete commands, options and their values, written
// from the same description that help is.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common/command_words.h"
#include "cli/common/commands.h"
#include "cli/common/exit_status.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "report/text/shell_word.h"

namespace gnomon::cli {

namespace {

using Words = std::vector<CommandWords>;

std::string spaced(const std::vector<std::string>& words, std::string_view between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

std::string listed(const Words& words) {
  std::vector<std::string> names;
  for (const CommandWords& command : words) names.push_back(command.name);
  return spaced(names);
}

/// The arms of a case over "command option" that say what the option takes.
std::string bash_values(const Words& words) {
  std::string text;
  for (const CommandWords& command : words) {
    for (const OptionWords& option : command.options) {
      if (!option.takes_value) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) {
        patterns.push_back(report::shell_word(command.name + " " + name));
      }
      std::string what = "return";  // anything: nothing is offered
      if (option.takes_file()) {
        what = "compgen_of -f";
      } else if (option.takes_directory()) {
        what = "compgen_of -d";
      } else if (!option.choices.empty()) {
        what = "compgen_of -W " + report::shell_word(spaced(option.choices));
      }
      text += fmt::format("    {}) {}; return ;;\n", spaced(patterns, "|"), what);
    }
  }
  return text;
}

std::string bash_options(const Words& words) {
  std::string text;
  for (const CommandWords& command : words) {
    std::vector<std::string> names;
    for (const OptionWords& option : command.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
    }
    text += fmt::format("    {}) options={} ;;\n", command.name, report::shell_word(spaced(names)));
  }
  return text;
}

std::string bash_script(const Words& words) {
  std::string text =
      "# bash completion of gnomon, written by `gnomon completion bash`\n"
      "_gnomon() {\n"
      "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} options=\n"
      "  COMPREPLY=()\n"
      "  # The shell takes --option=value for three words.\n"
      "  if [[ $cur == = ]]; then\n"
      "    cur=\n"
      "  elif [[ $prev == = ]]; then\n"
      "    prev=${COMP_WORDS[COMP_CWORD-2]}\n"
      "  fi\n"
      "  compgen_of() { mapfile -t COMPREPLY < <(compgen \"$@\" -- \"$cur\"); unset -f compgen_of; "
      "}\n"
      "  if [[ $COMP_CWORD -eq 1 ]]; then\n";
  text += fmt::format("    compgen_of -W {}\n    return\n  fi\n",
                      report::shell_word(listed(words) + " --help --help-all --version"));
  text += "  case \"${COMP_WORDS[1]} $prev\" in\n" + bash_values(words) + "  esac\n";
  text += "  case \"${COMP_WORDS[1]}\" in\n" + bash_options(words) + "  esac\n";
  return text +
         "  if [[ $cur == -* ]]; then\n"
         "    compgen_of -W \"$options\"\n"
         "  else\n"
         "    compgen_of -f\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _gnomon gnomon\n";
}

/// Of a word of _arguments: what stands between brackets or colons.
std::string for_zsh(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_value(const OptionWords& option) {
  if (!option.takes_value) return {};
  std::string text = ":" + for_zsh(option.value) + ":";
  if (option.takes_file()) return text + "_files";
  if (option.takes_directory()) return text + "_files -/";
  if (!option.choices.empty()) return text + "(" + spaced(option.choices) + ")";
  return text;
}

std::string zsh_script(const Words& words) {
  std::string text =
      "#compdef gnomon\n"
      "# zsh completion of gnomon, written by `gnomon completion zsh`\n"
      "_gnomon() {\n"
      "  local -a commands\n"
      "  if (( CURRENT == 2 )); then\n"
      "    commands=(\n";
  for (const CommandWords& command : words) {
    text += "      " + report::shell_word(for_zsh(command.name) + ":" + command.summary) + "\n";
  }
  text +=
      "    )\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n";
  for (const CommandWords& command : words) {
    text += "    " + command.name + ") _arguments -S";
    for (const OptionWords& option : command.options) {
      for (const std::string& name : option.names) {
        const std::string form = option.takes_value && name.starts_with("--") ? name + "=" : name;
        text +=
            " \\\n      " + report::shell_word((option.may_repeat ? "*" : "") + form + "[" +
                                               for_zsh(option.summary) + "]" + zsh_value(option));
      }
    }
    text += " \\\n      '*:file:_files' ;;\n";
  }
  return text +
         "  esac\n"
         "}\n"
         "if [ \"$funcstack[1]\" = _gnomon ]; then _gnomon \"$@\"; else compdef _gnomon gnomon; "
         "fi\n";
}

/// A word that fish quotes as it quotes its own: a backslash, too, hides what follows it.
std::string for_fish(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string fish_script(const Words& words) {
  std::string text =
      "# fish completion of gnomon, written by `gnomon completion fish`\n"
      "complete -c gnomon -n __fish_use_subcommand -f\n";
  for (const CommandWords& command : words) {
    text += fmt::format("complete -c gnomon -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        for_fish(command.summary));
  }
  for (const CommandWords& command : words) {
    const std::string here = for_fish("__fish_seen_subcommand_from " + command.name);
    for (const OptionWords& option : command.options) {
      text += "complete -c gnomon -n " + here;
      for (const std::string& name : option.names) {
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (option.takes_file() || option.takes_directory()) {
        text += " -r -F";
      } else if (!option.choices.empty()) {
        text += " -x -a " + for_fish(spaced(option.choices));
      } else if (option.takes_value) {
        text += " -x";
      }
      text += " -d " + for_fish(option.summary) + "\n";
    }
  }
  return text;
}

}  // namespace

void add_completion_command(CLI::App& app, Action& action) {
  auto shell = std::make_shared<std::string>();
  CLI::App& command = *app.add_subcommand(
      "completion", "Print what a shell needs to complete commands, options and values");
  command.footer(
      "Examples:\n"
      "  source <(gnomon completion bash)\n"
      "  gnomon completion zsh > ~/.zfunc/_gnomon\n"
      "  gnomon completion fish > ~/.config/fish/completions/gnomon.fish");
  command.add_option("SHELL", *shell, "bash, zsh or fish; commands: their names, a line each")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish", "commands"}))
      ->type_name("bash|zsh|fish|commands");
  command.callback([shell, &app, &action] {
    action = [shell, &app] {
      const Words words = command_words(app);
      std::string text;
      if (*shell == "bash") {
        text = bash_script(words);
      } else if (*shell == "zsh") {
        text = zsh_script(words);
      } else if (*shell == "fish") {
        text = fish_script(words);
      } else {
        for (const CommandWords& command : words) text += command.name + "\n";
      }
      const auto written = write_output({}, text);
      return written ? static_cast<int>(kDone) : report_error(written.error());
    };
  });
}

}  // namespace gnomon::cli
