// SPDX-License-Identifier: LGPL-3.0-or-later
// The method svbsp-full on one kernel, as the table of methods names it. CMake compiles it once a
// kernel.
#ifndef GNOMON_ALGORITHMS_SVBSP_FULL_BY_SVBSP_FULL_H
#define GNOMON_ALGORITHMS_SVBSP_FULL_BY_SVBSP_FULL_H

#include "algorithms/partition/run_task.h"

namespace gnomon {

template <class Kernel>
struct BySvbspFull {
  static Expected<ShadowResult> run(const RunTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_FULL_BY_SVBSP_FULL_H
