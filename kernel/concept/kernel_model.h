// SPDX-License-Identifier: LGPL-3.0-or-later
// What a kernel is to the algorithms: one struct that bundles its spaces. Algorithms are templates
// on it, and CMake compiles each method once for each struct that kernels.def lists.
#ifndef GNOMON_KERNEL_CONCEPT_KERNEL_MODEL_H
#define GNOMON_KERNEL_CONCEPT_KERNEL_MODEL_H

#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// - `LightSpace`: the scene seen from a point or directional light;
/// - `VolumeSpace`: the scene in three dimensions, with planes through any three points;
/// - `CountedLightSpace`, `CountedVolumeSpace` (optional): the same spaces with a count of
///   decisions for each stage that makes them. A kernel without stages has no such types.
template <class Kernel>
concept KernelModel =
    LightSpaceModel<typename Kernel::LightSpace> && VolumeSpaceModel<typename Kernel::VolumeSpace>;

/// Calls `body.template operator()<Space>()` on the kernel's light space, on the one that counts if
/// `count_stages` is set and the kernel has one.
template <KernelModel Kernel, class Body>
auto with_light_space(bool count_stages, const Body& body) {
  if constexpr (requires { typename Kernel::CountedLightSpace; }) {
    if (count_stages) return body.template operator()<typename Kernel::CountedLightSpace>();
  }
  return body.template operator()<typename Kernel::LightSpace>();
}

/// As with_light_space, on the kernel's volume space.
template <KernelModel Kernel, class Body>
auto with_volume_space(bool count_stages, const Body& body) {
  if constexpr (requires { typename Kernel::CountedVolumeSpace; }) {
    if (count_stages) return body.template operator()<typename Kernel::CountedVolumeSpace>();
  }
  return body.template operator()<typename Kernel::VolumeSpace>();
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_KERNEL_MODEL_H
