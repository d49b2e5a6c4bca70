// SPDX-License-Identifier: LGPL-3.0-or-later
// The methods basic and tiling on one kernel, as the table of methods names them. CMake compiles
// them once a kernel.
#ifndef GNOMON_ALGORITHMS_TILING_BY_VOLUMES_H
#define GNOMON_ALGORITHMS_TILING_BY_VOLUMES_H

#include "algorithms/partition/run_task.h"

namespace gnomon {

template <class Kernel>
struct ByVolumes {
  static Expected<ShadowResult> run(const RunTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TILING_BY_VOLUMES_H
