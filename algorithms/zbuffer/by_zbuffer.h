// SPDX-License-Identifier: LGPL-3.0-or-later
// The method zbuffer on one kernel, as the table of methods names it. CMake compiles it once a
// kernel.
#ifndef GNOMON_ALGORITHMS_ZBUFFER_BY_ZBUFFER_H
#define GNOMON_ALGORITHMS_ZBUFFER_BY_ZBUFFER_H

#include "algorithms/pixels/pixel_task.h"

namespace gnomon {

template <class Kernel>
struct ByZbuffer {
  static Expected<PixelWork> run(const PixelTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ZBUFFER_BY_ZBUFFER_H
