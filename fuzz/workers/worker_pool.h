// SPDX-License-Identifier: GPL-3.0-or-later
// Child processes that check scenes, several at once. One that crashes, hangs or eats memory is a
// failure of what it was at, and is replaced; the parent goes on. One event loop (libuv), no
// threads.
#ifndef GNOMON_FUZZ_WORKERS_WORKER_POOL_H
#define GNOMON_FUZZ_WORKERS_WORKER_POOL_H

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "fuzz/workers/worker.h"
#include "gnomon/kernel/error.h"

namespace gnomon::fuzz {

/// A line of worker.h, and what belongs to it.
struct Request {
  std::uint64_t index = 0;  // the caller's
  std::string text;         // all that is sent
};
Request case_request(std::uint64_t index, std::uint64_t seed, std::size_t generator);
/// Nothing if the scene cannot be written as JSON (numbers that are no doubles).
std::optional<Request> scene_request(const Scene& scene, std::uint64_t seed);

class WorkerPool {
 public:
  /// Processes are started when there is work. `seconds`: of one request.
  WorkerPool(WorkerCommand command, double seconds, unsigned workers);
  ~WorkerPool();

  struct Callbacks {
    std::function<std::optional<Request>()> next;  // nothing: no more work
    std::function<void(const Request&, WorkerAnswer)> answered;
    /// Every 100 ms; false: stop at once, requests under way are given up. May be empty.
    std::function<bool()> tick;
  };
  /// Until there is no more work and all of it is answered, or a tick says stop. Errors: kFile (the
  /// program cannot be started, or ends before it reads anything).
  Expected<void> run(const Callbacks& callbacks);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_WORKERS_WORKER_POOL_H
