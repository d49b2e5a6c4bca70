// SPDX-License-Identifier: GPL-3.0-or-later
// check.h in a child process: a crash, a hang and too much memory become failures like any other.
#ifndef GNOMON_FUZZ_WORKERS_ISOLATED_H
#define GNOMON_FUZZ_WORKERS_ISOLATED_H

#include <atomic>
#include <string>

#include "fuzz/workers/worker_pool.h"

namespace gnomon::fuzz {

class IsolatedChecker {
 public:
  /// `program`: the gnomon command itself (worker.h, WorkerCommand).
  IsolatedChecker(std::string program, const CheckOptions& check, const Limits& limits);

  /// A scene that cannot be written as JSON has no failures. Errors: kFile (the program cannot be
  /// started), kInterrupted.
  Expected<CaseReport> check(const Scene& scene, const std::atomic<bool>* interrupted = nullptr);

 private:
  std::uint64_t seed_;
  WorkerPool pool_;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_WORKERS_ISOLATED_H
