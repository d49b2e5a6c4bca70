// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/receiver_run.h"
#include "kernel/implicit/implicit_volume_space.h"

namespace gnomon {

Expected<AreaOutcome> area_plane(const PreparedScene& scene, const ShadowOptions& options,
                                 const LightList& lights, const LightList& combined) {
  return options.count_stages
             ? area_shadows_with<ImplicitVolumeSpace<CountStats>>(scene, options, lights, combined)
             : area_shadows_with<ImplicitVolumeSpace<NoStats>>(scene, options, lights, combined);
}

}  // namespace gnomon
