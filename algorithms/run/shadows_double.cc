// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/shadow_kernels.h"
#include "algorithms/run/svbsp_run.h"
#include "kernel/coordinate/coordinate_space.h"

namespace gnomon {

ShadowOutcome shadows_double(const PreparedScene& scene, const ShadowOptions& options,
                             const LightList& lights) {
  return compute_shadows_with<CoordinateLightSpace<double>>(scene, options, lights);
}

}  // namespace gnomon
