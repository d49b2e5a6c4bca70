// SPDX-License-Identifier: LGPL-3.0-or-later
// The rows of a picture on several threads: each makes a run of its own and takes every n-th row,
// so that nothing depends on their number but the time.
#ifndef GNOMON_ALGORITHMS_PIXELS_BY_ROWS_H
#define GNOMON_ALGORITHMS_PIXELS_BY_ROWS_H

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>

#include "algorithms/partition/run_task.h"
#include "algorithms/pixels/pixel_task.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

/// `make()` gives a thread its own run, which has fill_row(row), work(), which is added up, and
/// covered(), the pairs of a sample and a part that covers it.
template <class Make>
Expected<PixelWork> by_rows_of(const PixelTask& task, const Make& make) {
  const std::uint32_t rows = task.frame.height;
  const auto threads =
      std::min<std::uint32_t>(static_cast<std::uint32_t>(thread_count(task.options.jobs)), rows);
  PixelWork total;
  std::uint64_t covered = 0;
  std::uint32_t done = 0;
  std::mutex mutex;
  std::atomic<bool> stopped = false;
  const auto work = [&](std::uint32_t first) {
    auto run = make();
    for (std::uint32_t row = first; row < rows; row += threads) {
      if (task.interrupted()) stopped = true;
      if (stopped) return;
      run.fill_row(row);
      const std::lock_guard lock(mutex);
      ++done;
      if (task.options.control.progress) {
        task.options.control.progress(static_cast<double>(done) / rows);
      }
    }
    const std::lock_guard lock(mutex);
    const PixelWork own = run.work();
    total.work += own.work;
    total.lookup_seconds += own.lookup_seconds;
    total.stages += run.stages();
    covered += run.covered();
  };
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(
      [&] { tbb::parallel_for(std::uint32_t{0}, threads, work, tbb::simple_partitioner()); });
  if (stopped) return stopped_by(RunOutcome::kInterrupted, {});
  constexpr std::uint64_t kMillion = 1'000'000;
  total.work[Counter::kDepthComplexity] =
      covered * kMillion / (std::uint64_t{rows} * task.frame.width);
  return total;
}

/// Of runs that are made from a task alone.
template <class Run>
Expected<PixelWork> by_rows(const PixelTask& task) {
  return by_rows_of(task, [&] { return Run(task); });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_BY_ROWS_H
