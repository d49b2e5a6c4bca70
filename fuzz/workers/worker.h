// SPDX-License-Identifier: GPL-3.0-or-later
// The child process in which subjects run, and what it says to its parent. A request is a line on
// its standard input; it answers with lines on its standard output: `@STAGE` before each step, so
// that the parent knows what it was at if it never comes back, and `=REPORT` (JSON) at the end.
//
//   case INDEX SEED GENERATOR     makes a scene and checks it (GENERATOR: a number, in order of
//                                 WorkerOptions::generators)
//   scene SEED LENGTH             checks the scene of the LENGTH bytes of JSON that follow the line
#ifndef GNOMON_FUZZ_WORKERS_WORKER_H
#define GNOMON_FUZZ_WORKERS_WORKER_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/check/check.h"
#include "fuzz/check/property.h"
#include "gnomon/kernel/error.h"

namespace gnomon::fuzz {

/// What a request may cost.
struct Limits {
  double seconds = 10;
  std::uint64_t megabytes = 2048;  // of address space, beyond what the program itself takes
};

struct WorkerOptions {
  std::vector<std::string> generators;
  CheckOptions check;
  /// The first exact subject runs on every scene, the others take turns: the scene's seed chooses
  /// one. Only every eighth scene is checked at length (CheckOptions::brief).
  bool in_turn = false;
  Limits limits;
};

/// How to start one: a program that ends in run_worker().
struct WorkerCommand {
  std::string program;
  std::vector<std::string> arguments;
};

/// The command line of `gnomon worker` for these options: PROGRAM worker --generator ...
WorkerCommand worker_command(std::string program, const WorkerOptions& options);

struct WorkerAnswer {
  CaseReport report;
  std::string recipe;                // of a case: what its scene was made by
  std::vector<std::uint16_t> kinds;  // of a case: indices into kinds()
};

std::string answer_text(const WorkerAnswer& answer);
/// Errors: kSyntax, kFormat.
Expected<WorkerAnswer> parse_answer(std::string_view text);

/// Serves requests until its input ends. Errors: kUsage for options that make no sense.
Expected<void> run_worker(const WorkerOptions& options);

/// Failures have a text form of their own, in databases and findings too.
std::string failure_text(const Failure& failure);
/// Errors: kSyntax, kFormat.
Expected<Failure> parse_failure(std::string_view text);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_WORKERS_WORKER_H
