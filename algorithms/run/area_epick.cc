// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/receiver_run.h"
#include "kernel/cgal/epick_volume_space.h"

namespace gnomon {

Expected<AreaOutcome> area_epick(const PreparedScene& scene, const ShadowOptions& options,
                                 const LightList& lights, const LightList& combined) {
  return area_shadows_with<EpickVolumeSpace>(scene, options, lights, combined);
}

}  // namespace gnomon
