// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/receiver_run.h"
#include "kernel/coordinate/coordinate_volume_space.h"

namespace gnomon {

Expected<AreaOutcome> area_rational(const PreparedScene& scene, const ShadowOptions& options,
                                    const LightList& lights, const LightList& combined) {
  return area_shadows_with<CoordinateVolumeSpace<mpq_class>>(scene, options, lights, combined);
}

}  // namespace gnomon
