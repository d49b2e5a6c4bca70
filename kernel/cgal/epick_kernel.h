// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel epick: rounded points, and exact predicates on them.
#ifndef GNOMON_KERNEL_CGAL_EPICK_KERNEL_H
#define GNOMON_KERNEL_CGAL_EPICK_KERNEL_H

#include "kernel/cgal/epick_image_space.h"
#include "kernel/cgal/epick_space.h"
#include "kernel/cgal/epick_volume_space.h"

namespace gnomon {

struct EpickKernel {
  using LightSpace = EpickLightSpace;
  using VolumeSpace = EpickVolumeSpace;
  using ImageSpace = EpickImageSpace;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPICK_KERNEL_H
