// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/command_line.h"

#include "report/text/shell_word.h"

namespace gnomon::cli {

namespace {

std::string typed_line;

}  // namespace

void set_command_line(int argc, const char* const* argv) {
  // Whatever path the program was called by: others have it elsewhere.
  typed_line = "gnomon";
  for (int i = 1; i < argc; ++i) typed_line += ' ' + report::shell_word(argv[i]);
}

const std::string& command_line() { return typed_line; }

std::string program_version() { return "gnomon " GNOMON_VERSION; }

}  // namespace gnomon::cli
