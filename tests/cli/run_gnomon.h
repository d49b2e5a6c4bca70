// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the gnomon program as a user does, and looks at what comes out.
#ifndef GNOMON_TESTS_CLI_RUN_GNOMON_H
#define GNOMON_TESTS_CLI_RUN_GNOMON_H

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/test_directory.h"

namespace gnomon::test {

struct RunOptions {
  std::string input;                     // for standard input
  std::string stdout_path;               // standard output goes to this file instead
  bool close_pipe = false;               // standard output is a pipe that nobody reads
  std::vector<std::string> environment;  // "NAME=VALUE", added
  int signal = 0;                        // sent once the program catches it and ...
  std::function<bool()> signal_when;     // ... this holds (asked over and over), and then ...
  double signal_after = 0;               // ... so many seconds later
};

struct RunResult {
  int status = -1;  // exit status; 1000 + signal if a signal ended it
  std::string out, err;
};

RunResult run_gnomon(const std::vector<std::string>& arguments, const RunOptions& options = {});

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_CLI_RUN_GNOMON_H
