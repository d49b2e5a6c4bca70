// SPDX-License-Identifier: GPL-3.0-or-later
// --jobs: how many threads a command works on. No answer depends on it.
#ifndef GNOMON_CLI_COMMON_JOBS_H
#define GNOMON_CLI_COMMON_JOBS_H

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <optional>

namespace gnomon::cli {

/// --jobs N, 0..1024; 0: as many as there are processors. More than that many only slows down, and
/// shows that the answer stays the same.
void add_jobs_option(CLI::App& command, unsigned& jobs);

/// While it lives, everything that this process does works on at most `jobs` threads: preparation,
/// shadows, oracle.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned jobs) {
    if (jobs > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, jobs);
  }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  std::optional<tbb::global_control> control_;
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_JOBS_H
