// SPDX-License-Identifier: GPL-3.0-or-later
// A foreign program, run by the shell with limits on its time, memory and output: it may hang,
// crash, fork or flood, and the caller goes on. Everything that it started ends with it.
#ifndef GNOMON_FUZZ_PROCESS_COMMAND_H
#define GNOMON_FUZZ_PROCESS_COMMAND_H

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"

namespace gnomon::fuzz {

struct CommandOptions {
  std::vector<std::string> arguments;             // added to the command line, quoted
  std::string input;                              // its standard input, as a file
  double seconds = 10;                            // of the clock on the wall
  std::uint64_t megabytes = 2048;                 // address space of each process; 0: no limit
  std::uint64_t most_output = 256 * 1024 * 1024;  // bytes of standard output
  const std::atomic<bool>* interrupted = nullptr;
};

enum class CommandEnd : std::uint8_t {
  kExited,    // with `status`
  kSignal,    // by signal `status`: a crash
  kTimeout,   // killed after `seconds`
  kTooLong,   // killed after `most_output`
  kNotFound,  // the shell could not run it
};

struct CommandResult {
  CommandEnd end = CommandEnd::kExited;
  int status = 0;  // exit status, or the signal
  std::string out;
  std::string errors;  // standard error, its first 64 KiB
  double seconds = 0;  // wall clock

  bool succeeded() const { return end == CommandEnd::kExited && status == 0; }
};

/// Runs `COMMAND ARGUMENTS...` with /bin/sh. May be called from several threads at once. A command
/// that the shell reports as 128 + n ended by signal n. Errors: kFile (no process, no pipe),
/// kInterrupted.
Expected<CommandResult> run_command(const std::string& command, const CommandOptions& options);

/// How it ended, for a message: "exit status 2", "signal 11 (Segmentation fault)", "no end within
/// 10 s", with the first line of its standard error where there is one.
std::string how_it_ended(const CommandResult& result);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_PROCESS_COMMAND_H
