// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel plane: no vertex is constructed, each is known by the planes that meet in it.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_KERNEL_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_KERNEL_H

#include "kernel/implicit/implicit_image_space.h"
#include "kernel/implicit/implicit_light_space.h"
#include "kernel/implicit/implicit_volume_space.h"

namespace gnomon {

struct ImplicitKernel {
  using LightSpace = ImplicitLightSpace<NoStats>;
  using VolumeSpace = ImplicitVolumeSpace<NoStats>;
  using ImageSpace = ImplicitImageSpace<NoStats>;
  using CountedLightSpace = ImplicitLightSpace<CountStats>;
  using CountedVolumeSpace = ImplicitVolumeSpace<CountStats>;
  using CountedImageSpace = ImplicitImageSpace<CountStats>;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_KERNEL_H
