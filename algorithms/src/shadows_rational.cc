// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/kernel/coordinate_space.h"
#include "shadow_kernels.h"
#include "shadows_impl.h"

namespace gnomon {

ShadowOutcome shadows_rational(const PreparedScene& scene, const ShadowOptions& options,
                               const LightList& lights) {
  return compute_shadows_with<CoordinateLightSpace<mpq_class>>(scene, options, lights);
}

}  // namespace gnomon
