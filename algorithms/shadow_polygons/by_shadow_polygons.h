// SPDX-License-Identifier: LGPL-3.0-or-later
// The method shadow-polygons on one kernel, as the table of methods names it. CMake compiles it
// once a kernel.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_BY_SHADOW_POLYGONS_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_BY_SHADOW_POLYGONS_H

#include "algorithms/pixels/pixel_task.h"

namespace gnomon {

template <class Kernel>
struct ByShadowPolygons {
  static Expected<PixelWork> run(const PixelTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_BY_SHADOW_POLYGONS_H
