// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel of watched runs. It is in no list of kernels, since nobody chooses it:
// algorithms/run/explain.cc runs methods on it.
#ifndef GNOMON_KERNEL_WATCHED_WATCHED_KERNEL_H
#define GNOMON_KERNEL_WATCHED_WATCHED_KERNEL_H

#include "kernel/watched/watched_light_space.h"
#include "kernel/watched/watched_volume_space.h"

namespace gnomon {

struct WatchedKernel {
  using LightSpace = WatchedLightSpace;
  using VolumeSpace = WatchedVolumeSpace;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_WATCHED_KERNEL_H
