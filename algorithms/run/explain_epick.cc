// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/explain_run.h"
#include "kernel/cgal/epick_space.h"

namespace gnomon {

Explanation explain_epick(const PreparedScene& scene, const ShadowOptions& options,
                          const LightList& lights) {
  return explain_with<EpickLightSpace>(scene, options, lights);
}

}  // namespace gnomon
