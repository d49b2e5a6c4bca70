// SPDX-License-Identifier: GPL-3.0-or-later
// One line each on standard error, the program's name in front.
#ifndef GNOMON_CLI_COMMON_MESSAGES_H
#define GNOMON_CLI_COMMON_MESSAGES_H

#include <string>
#include <string_view>

#include "cli/common/exit_status.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

/// Prints "gnomon: FILE:LINE:COLUMN: what; expected" and returns the status that goes with it.
ExitStatus report_error(const Error& error);
/// The same for a wrong option or argument.
ExitStatus report_usage(std::string what, std::string expected = {}, std::string file = {});
/// "gnomon: ...": what was done, where nobody would see it otherwise.
void say(std::string_view text);
/// "gnomon: warning: ...", once for each text.
void warn(std::string_view text);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_MESSAGES_H
