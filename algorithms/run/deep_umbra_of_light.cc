// SPDX-License-Identifier: LGPL-3.0-or-later
// The deep umbra of a light that has not been classified yet.
#include "gnomon/algorithms/deep_umbra.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon {

Expected<std::vector<DeepUmbraBounds>> deep_umbra_bounds(const PreparedScene& scene,
                                                         std::uint32_t light,
                                                         const DeepUmbraOptions& options) {
  ShadowOptions shadows;
  shadows.lights = {light};
  shadows.output.exact_points = true;
  shadows.control.interrupted = options.interrupted;
  const auto classified = compute_shadows(scene, shadows);
  if (!classified) return tl::unexpected(classified.error());
  return deep_umbra_bounds(scene, classified->lights[0], options);
}

}  // namespace gnomon
