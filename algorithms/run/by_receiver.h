// SPDX-License-Identifier: LGPL-3.0-or-later
// Lights of any kind receiver by receiver on one kernel, as the table of methods names it: by pairs
// of casters and receivers, by the volume trees, or piece by piece of an area light. CMake compiles
// it once a kernel.
#ifndef GNOMON_ALGORITHMS_RUN_BY_RECEIVER_H
#define GNOMON_ALGORITHMS_RUN_BY_RECEIVER_H

#include "algorithms/partition/run_task.h"

namespace gnomon {

template <class Kernel>
struct ByReceiver {
  static Expected<ShadowResult> run(const RunTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_BY_RECEIVER_H
