// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/shadow_kernels.h"
#include "algorithms/run/svbsp_run.h"
#include "kernel/implicit/implicit_light_space.h"

namespace gnomon {

ShadowOutcome shadows_plane(const PreparedScene& scene, const ShadowOptions& options,
                            const LightList& lights) {
  return options.count_stages
             ? compute_shadows_with<ImplicitLightSpace<CountStats>>(scene, options, lights)
             : compute_shadows_with<ImplicitLightSpace<NoStats>>(scene, options, lights);
}

}  // namespace gnomon
