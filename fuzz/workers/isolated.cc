// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/workers/isolated.h"

#include <optional>
#include <utility>

namespace gnomon::fuzz {

IsolatedChecker::IsolatedChecker(std::string program, const CheckOptions& check,
                                 const Limits& limits)
    : seed_(check.seed),
      pool_(
          worker_command(std::move(program), {.generators = {}, .check = check, .limits = limits}),
          limits.seconds, 1) {}

Expected<CaseReport> IsolatedChecker::check(const Scene& scene,
                                            const std::atomic<bool>* interrupted) {
  std::optional<Request> request = scene_request(scene, seed_);
  if (!request) return CaseReport{};
  std::optional<CaseReport> report;
  WorkerPool::Callbacks callbacks;
  callbacks.next = [&] { return std::exchange(request, std::nullopt); };
  callbacks.answered = [&](const Request&, WorkerAnswer answer) {
    report = std::move(answer.report);
  };
  callbacks.tick = [&] { return interrupted == nullptr || !interrupted->load(); };
  if (const auto done = pool_.run(callbacks); !done) return tl::unexpected(done.error());
  if (!report) return fail(ErrorCode::kInterrupted, "interrupted");
  return std::move(*report);
}

}  // namespace gnomon::fuzz
