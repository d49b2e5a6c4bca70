// SPDX-License-Identifier: LGPL-3.0-or-later
// The method scan-out on one kernel, as the table of methods names it. CMake compiles it once a
// kernel.
#ifndef GNOMON_ALGORITHMS_SCAN_OUT_BY_SCAN_OUT_H
#define GNOMON_ALGORITHMS_SCAN_OUT_BY_SCAN_OUT_H

#include "algorithms/pixels/pixel_task.h"

namespace gnomon {

template <class Kernel>
struct ByScanOut {
  static Expected<PixelWork> run(const PixelTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCAN_OUT_BY_SCAN_OUT_H
