// SPDX-License-Identifier: LGPL-3.0-or-later
// The sectors method on one kernel, as the table of methods names it. CMake compiles it once a
// kernel.
#ifndef GNOMON_ALGORITHMS_SECTORS_BY_SECTORS_H
#define GNOMON_ALGORITHMS_SECTORS_BY_SECTORS_H

#include <vector>

#include "algorithms/partition/run_task.h"
#include "gnomon/algorithms/caster_counts.h"

namespace gnomon {

template <class Kernel>
struct BySectors {
  static Expected<ShadowResult> run(const RunTask& task);
  /// In place of classes, how many casters there are before each part (caster_counts.h).
  static Expected<std::vector<CasterCounts>> count(const RunTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_BY_SECTORS_H
