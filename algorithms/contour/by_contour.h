// SPDX-License-Identifier: LGPL-3.0-or-later
// The contour method on one kernel, as the table of methods names it. CMake compiles it once a
// kernel.
#ifndef GNOMON_ALGORITHMS_CONTOUR_BY_CONTOUR_H
#define GNOMON_ALGORITHMS_CONTOUR_BY_CONTOUR_H

#include "algorithms/partition/run_task.h"

namespace gnomon {

template <class Kernel>
struct ByContour {
  static Expected<ShadowResult> run(const RunTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_BY_CONTOUR_H
