// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/explain_run.h"
#include "kernel/coordinate/coordinate_space.h"

namespace gnomon {

Explanation explain_coordinates(const PreparedScene& scene, const ShadowOptions& options,
                                const LightList& lights) {
  switch (options.kernel) {
    case KernelId::kFloat:
      return explain_with<CoordinateLightSpace<float>>(scene, options, lights);
    case KernelId::kLongDouble:
      return explain_with<CoordinateLightSpace<long double>>(scene, options, lights);
    default:
      return explain_with<CoordinateLightSpace<double>>(scene, options, lights);
  }
}

}  // namespace gnomon
