// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel epeck: CGAL's lazily evaluated exact numbers.
#ifndef GNOMON_KERNEL_CGAL_EPECK_KERNEL_H
#define GNOMON_KERNEL_CGAL_EPECK_KERNEL_H

#include "kernel/cgal/epeck_image_space.h"
#include "kernel/cgal/epeck_space.h"
#include "kernel/cgal/epeck_volume_space.h"

namespace gnomon {

struct EpeckKernel {
  using LightSpace = EpeckLightSpace;
  using VolumeSpace = EpeckVolumeSpace;
  using ImageSpace = EpeckImageSpace;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPECK_KERNEL_H
