// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of `gnomon`, one source each. Each adds its options to the parser and, when it is
// the one that was typed, leaves an action to run; the action returns the exit status.
#ifndef GNOMON_CLI_COMMON_COMMANDS_H
#define GNOMON_CLI_COMMON_COMMANDS_H

#include <CLI/CLI.hpp>
#include <functional>

namespace gnomon::cli {

using Action = std::function<int()>;

void add_shadows_command(CLI::App& app, Action& action);
void add_certify_command(CLI::App& app, Action& action);
void add_verify_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);
void add_systems_command(CLI::App& app, Action& action);
void add_generate_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_advise_command(CLI::App& app, Action& action);
void add_extremes_command(CLI::App& app, Action& action);
void add_tradeoff_command(CLI::App& app, Action& action);
void add_measure_command(CLI::App& app, Action& action);
void add_convert_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_lines_command(CLI::App& app, Action& action);
void add_pixels_command(CLI::App& app, Action& action);
void add_shrink_command(CLI::App& app, Action& action);
void add_replay_command(CLI::App& app, Action& action);
void add_fuzz_command(CLI::App& app, Action& action);
void add_illumination_command(CLI::App& app, Action& action);
void add_loops_command(CLI::App& app, Action& action);
void add_visible_command(CLI::App& app, Action& action);
void add_worker_command(CLI::App& app, Action& action);
void add_year_command(CLI::App& app, Action& action);
void add_completion_command(CLI::App& app, Action& action);

/// A finite number, 0 or more.
CLI::Validator not_negative();
/// An option that may be given several times, one value each.
CLI::Option* repeatable(CLI::Option* option);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_COMMANDS_H
