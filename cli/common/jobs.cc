// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/jobs.h"

namespace gnomon::cli {

void add_jobs_option(CLI::App& command, unsigned& jobs) {
  constexpr unsigned kMostJobs = 1024;
  command.add_option("-j,--jobs", jobs, "Threads, at most 1024; 0: one a processor")
      ->check(CLI::Range(0u, kMostJobs))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace gnomon::cli
