// SPDX-License-Identifier: GPL-3.0-or-later
// The command line: finds the command, runs it, and turns whatever happens into one clear line and
// an exit status.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/command_line.h"
#include "cli/common/command_words.h"
#include "cli/common/commands.h"
#include "cli/common/exit_status.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/misspelt.h"
#include "cli/common/output.h"

namespace gnomon::cli {

CLI::Validator not_negative() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double value = 0;
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool number = failure == std::errc() && end == text.data() + text.size();
        if (number && std::isfinite(value) && value >= 0) return {};
        return "'" + text + "' is no finite number of 0 or more";
      },
      "NUMBER");
}

CLI::Option* repeatable(CLI::Option* option) { return option->allow_extra_args(false)->take_all(); }

namespace {

/// The deepest command that was typed, for "see 'gnomon shadows --help'".
std::string typed_command(const CLI::App& app) {
  std::string name = "gnomon";
  for (const CLI::App* command : app.get_subcommands()) name += " " + command->get_name();
  return name;
}

/// The deepest command that was typed.
const CLI::App& deepest(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().back();
  return *command;
}

/// What CLI11 says of words that no option takes, in the order in which they were typed, and the
/// option that the first of them perhaps means.
std::string not_expected(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  std::string what = words.size() == 1 ? "The following argument was not expected:"
                                       : "The following arguments were not expected:";
  for (const std::string& word : words) what += " " + word;
  std::vector<std::string> options;
  for (const CLI::Option* option : deepest(app).get_options()) {
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  }
  const std::string first = words.empty() ? "" : words.front().substr(0, words.front().find('='));
  const std::string meant = first.starts_with("--") ? nearest_word(first, options) : "";
  return meant.empty() ? what : what + "; did you mean " + meant + "?";
}

int usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  std::string what = is_extra ? not_expected(app) : error.what();
  while (!what.empty() && (what.back() == '\n' || what.back() == '.')) what.pop_back();
  return report_usage(what + "; see '" + typed_command(app) + " --help'");
}

int print(const std::string& text) {
  const auto written = write_output({}, text);
  return written ? kDone : report_error(written.error());
}

/// Of `gnomon`, `gnomon help` and `gnomon help COMMAND`, and of a command that there is not; none
/// for all that is to be parsed.
std::optional<int> run_without_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2) {
    std::fputs(app.help().c_str(), stderr);
    return kBadInput;
  }
  std::string typed = argv[1];
  const bool asks_for_help = typed == "help";
  if (asks_for_help && argc == 2) return print(app.help());
  if (asks_for_help) typed = argv[2];
  const CLI::App* command = command_by_name(app, typed);
  if (asks_for_help && command != nullptr) return print(command->help("gnomon"));
  if (typed.starts_with('-') || command != nullptr) return std::nullopt;
  const std::string meant = nearest_word(typed, command_names(app));
  if (meant.empty()) {
    return report_usage("no command '" + typed + "'", "one that 'gnomon --help' lists");
  }
  return report_usage("no command '" + typed + "'; did you mean " + meant + "?");
}

int run(int argc, char** argv) {
  set_command_line(argc, argv);
  CLI::App app("Exact shadows of polygons, and the verdict on every other number type.", "gnomon");
  app.set_version_flag("--version", program_version(), "Print the version and exit");
  app.set_help_all_flag("--help-all", "Print the help of every command and exit");
  app.get_formatter()->column_width(34);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done, every verdict identical or within tolerance; 1 a candidate or rounded\n"
      "kernel failed; 2 bad usage or input, or a file that cannot be read or written; 3 a limit;\n"
      "4 exact kernels and oracle disagree (a bug of ours); 130 interrupted.\n\n"
      "Example:\n  gnomon generate table-chair -o table.json && gnomon certify table.json");
  Action action;
  add_certify_command(app, action);
  add_shadows_command(app, action);
  add_year_command(app, action);
  add_verify_command(app, action);
  add_render_command(app, action);
  add_pixels_command(app, action);
  add_visible_command(app, action);
  add_illumination_command(app, action);
  add_loops_command(app, action);
  add_lines_command(app, action);
  add_info_command(app, action);
  add_compare_command(app, action);
  add_tradeoff_command(app, action);
  add_extremes_command(app, action);
  add_advise_command(app, action);
  add_systems_command(app, action);
  add_generate_command(app, action);
  add_convert_command(app, action);
  add_shrink_command(app, action);
  add_fuzz_command(app, action);
  add_replay_command(app, action);
  add_measure_command(app, action);
  add_worker_command(app, action);
  add_completion_command(app, action);
  if (const auto status = run_without_command(app, argc, argv)) return *status;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForAllHelp&) {
    return print(app.help("", CLI::AppFormatMode::All));
  } catch (const CLI::CallForHelp&) {
    return print(app.help());
  } catch (const CLI::CallForVersion&) {
    return print(program_version() + '\n');
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error);
  }
  return action();
}

}  // namespace
}  // namespace gnomon::cli

int main(int argc, char** argv) {
  using namespace gnomon;
  cli::install_signal_handlers();
  try {
    return cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    // Nothing that would need memory again.
    std::fputs("gnomon: out of memory; a smaller scene may fit\n", stderr);
    return cli::kLimitReached;
  } catch (const std::exception& error) {
    cli::report_usage(std::string("internal error, please report it with the scene: ") +
                      error.what());
    return cli::kDisagree;
  }
}
