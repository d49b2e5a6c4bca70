// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/mutant_space.h"
#include "algorithms/run/shadow_kernels.h"
#include "algorithms/run/svbsp_run.h"

namespace gnomon {

ShadowOutcome shadows_planes_from_fragments(const PreparedScene& scene,
                                            const ShadowOptions& options, const LightList& lights) {
  return compute_by_svbsp<FragmentPlanesLightSpace<double>>(scene, options, rules_of(options.mutation), lights);
}

}  // namespace gnomon
