// SPDX-License-Identifier: LGPL-3.0-or-later
// The method ridge-edges on one kernel, as the table of methods names it. CMake compiles it once a
// kernel.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_BY_RIDGE_EDGES_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_BY_RIDGE_EDGES_H

#include "algorithms/pixels/pixel_task.h"

namespace gnomon {

template <class Kernel>
struct ByRidgeEdges {
  static Expected<PixelWork> run(const PixelTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_BY_RIDGE_EDGES_H
