// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C, SIGTERM and the end of the terminal (SIGHUP) ask the work to stop; a second one stops the
// program at once. Results are written under another name first, so that no half-written file takes
// a place.
#ifndef GNOMON_CLI_COMMON_INTERRUPT_H
#define GNOMON_CLI_COMMON_INTERRUPT_H

#include <atomic>

namespace gnomon::cli {

/// Installs the handlers; SIGPIPE is ignored, so that a closed pipe shows up as a write error.
void install_signal_handlers();
/// Becomes true when the user asks to stop.
const std::atomic<bool>& interrupted();

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_INTERRUPT_H
