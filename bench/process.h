// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a program and tells what it wrote and took.
#ifndef GNOMON_BENCH_PROCESS_H
#define GNOMON_BENCH_PROCESS_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::bench {

struct ProcessRun {
  int status = 0;                // of its end; 128 and the signal's number if a signal ended it
  std::string text;              // of the stream that was kept
  double cpu = 0;                // seconds, of user and system together
  std::uint64_t peak_bytes = 0;  // resident; not below this process's own when it started the other
};

/// Which stream is kept; standard output that is not kept goes nowhere, errors to ours.
enum class Keep { kOutput, kErrors };

/// `words`: without the program's name. None if the program could not be started.
std::optional<ProcessRun> run_process(const std::string& program, std::vector<std::string> words,
                                      Keep keep);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_PROCESS_H
