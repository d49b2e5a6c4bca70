// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/kernel/plane_light_space.h"
#include "shadow_kernels.h"
#include "shadows_impl.h"

namespace gnomon {

ShadowOutcome shadows_plane(const PreparedScene& scene, const ShadowOptions& options,
                            const LightList& lights) {
  return options.count_stages
             ? compute_shadows_with<PlaneLightSpace<CountStats>>(scene, options, lights)
             : compute_shadows_with<PlaneLightSpace<NoStats>>(scene, options, lights);
}

}  // namespace gnomon
