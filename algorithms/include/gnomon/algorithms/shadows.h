// SPDX-License-Identifier: LGPL-3.0-or-later
// The one entry point: classify a prepared scene on a kernel chosen at run time.
#ifndef GNOMON_ALGORITHMS_SHADOWS_H
#define GNOMON_ALGORITHMS_SHADOWS_H

#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// False for kernels that were left out of the build (GNOMON_CGAL_KERNELS).
bool has_kernel(KernelId kernel);

/// Classifies every part for every light asked for. Errors: kUsage (no such light, a thickness
/// outside [0, 1), a kernel that was not
/// built), kInterrupted, kLimit (max_fragments; more than 64 lights with `combined`).
Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOWS_H
