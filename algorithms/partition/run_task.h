// SPDX-License-Identifier: LGPL-3.0-or-later
// What every method is given to do, and how it says that it had to stop: the one signature behind
// the table of methods. The front door (run/compute.h) has checked the options and chosen the
// lights.
#ifndef GNOMON_ALGORITHMS_PARTITION_RUN_TASK_H
#define GNOMON_ALGORITHMS_PARTITION_RUN_TASK_H

#include <algorithm>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "algorithms/partition/rules.h"
#include "algorithms/partition/run_options.h"
#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Indices into PreparedScene::lights.
using LightList = std::vector<std::uint32_t>;

struct RunTask {
  const PreparedScene& scene;
  const ShadowOptions& options;
  const Rules& rules;
  const LightList& lights;    // classified one by one
  const LightList& combined;  // classified together, besides; at most 64, most often none
};

/// A method on a kernel. Fills the lights, the combined fragments and the counts of the result.
/// Errors: kInterrupted, kLimit.
using MethodFunction = Expected<ShadowResult> (*)(const RunTask&);

/// How the run of one light ended.
enum class RunOutcome : std::uint8_t { kDone, kInterrupted, kTooManyFragments, kNoIeee };

/// Why there is no result. Requires: the run was not done.
inline tl::unexpected<Error> stopped_by(RunOutcome outcome, const ShadowOptions& options) {
  if (outcome == RunOutcome::kTooManyFragments) {
    return fail(ErrorCode::kLimit,
                "more than " + std::to_string(options.limits.fragments) + " fragments",
                "a simpler scene, or a higher limit");
  }
  if (outcome == RunOutcome::kNoIeee) {
    // The thread that called has been checked before the run (select_lights).
    return fail(ErrorCode::kUsage, "a thread of the run does not compute as IEEE 754 has it",
                "rounding to nearest, and subnormal numbers, in every thread");
  }
  return fail(ErrorCode::kInterrupted, "interrupted");
}

/// The number of threads for ShadowOptions::jobs: more than processors would only wait for each
/// other.
inline int thread_count(unsigned jobs) {
  const unsigned most = std::max(1u, std::thread::hardware_concurrency());
  return static_cast<int>(jobs == 0 ? most : std::min(jobs, most));
}

/// The part of the public options that one light's run is told.
inline RunOptions run_options_of(const ShadowOptions& options) {
  RunOptions own{options.output, options.limits, options.tuning, options.method.prefix,
                 options.control.interrupted};
  own.output.merge = own.output.merge && options.method.options.merge != MergeOf::kNone;
  return own;
}

/// The result of a run on this kernel, before any light.
inline ShadowResult empty_result(const ShadowOptions& options) {
  const KernelInfo& kernel = kernel_info(options.kernel.id);
  ShadowResult result;
  result.kernel = kernel.name;
  result.exact = kernel.exact;
  result.identity = options.kernel.identity || kernel.exact;
  result.thickness = kernel.exact ? 0 : options.kernel.thickness;
  return result;
}

/// Hands a finished light to who waits for it, or keeps it in the result. False: the run is to stop
/// (RunOutcome::kInterrupted). Every method passes its lights here, in their order.
[[nodiscard]] inline bool put_light(const ShadowOptions& options, LightResult light,
                                    ShadowResult& result) {
  if (options.control.light_done) return options.control.light_done(std::move(light));
  result.lights.push_back(std::move(light));
  return true;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_RUN_TASK_H
