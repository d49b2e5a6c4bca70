// SPDX-License-Identifier: GPL-3.0-or-later
// How the program was called, as a line that a shell takes.
#ifndef GNOMON_CLI_COMMON_COMMAND_LINE_H
#define GNOMON_CLI_COMMON_COMMAND_LINE_H

#include <string>

namespace gnomon::cli {

/// Once, at the start.
void set_command_line(int argc, const char* const* argv);
/// "gnomon certify 'my room.json' --report out".
const std::string& command_line();
/// "gnomon 0.1.0".
std::string program_version();

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_COMMAND_LINE_H
