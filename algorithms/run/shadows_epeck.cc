// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/shadow_kernels.h"
#include "algorithms/run/svbsp_run.h"
#include "kernel/cgal/epeck_space.h"

namespace gnomon {

ShadowOutcome shadows_epeck(const PreparedScene& scene, const ShadowOptions& options,
                            const LightList& lights) {
  return compute_shadows_with<EpeckLightSpace>(scene, options, lights);
}

}  // namespace gnomon
