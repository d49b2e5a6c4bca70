// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/mutant_space.h"
#include "algorithms/run/receiver_run.h"
#include "algorithms/run/shadow_kernels.h"
#include "algorithms/run/svbsp_run.h"

namespace gnomon {

ShadowOutcome shadows_vertices_per_side(const PreparedScene& scene, const ShadowOptions& options,
                                        const LightList& lights) {
  return compute_shadows_with<SplitVerticesLightSpace<double>>(scene, options, lights);
}

Expected<AreaOutcome> area_vertices_per_side(const PreparedScene& scene,
                                             const ShadowOptions& options, const LightList& lights,
                                             const LightList& combined) {
  return area_shadows_with<SplitVerticesVolumeSpace<double>>(scene, options, lights, combined);
}

}  // namespace gnomon
