// SPDX-License-Identifier: LGPL-3.0-or-later
#include "explain_impl.h"
#include "gnomon/kernel/epick_space.h"

namespace gnomon {

Explanation explain_epick(const PreparedScene& scene, const ShadowOptions& options,
                          const LightList& lights) {
  return explain_with<EpickLightSpace>(scene, options, lights);
}

}  // namespace gnomon
