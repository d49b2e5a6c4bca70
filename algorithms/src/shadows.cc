// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/shadows.h"

#include "gnomon/kernel/fp_environment.h"
#include "light_selection.h"
#include "shadow_kernels.h"

namespace gnomon {

Expected<std::vector<std::uint32_t>> select_lights(const PreparedScene& scene,
                                                   const ShadowOptions& options) {
  if (const auto environment = check_fp_environment(); !environment) {
    return tl::unexpected<Error>(environment.error());
  }
  std::vector<std::uint32_t> lights = options.lights;
  if (lights.empty()) {
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
      if (scene.lights[i].type != LightType::kArea) lights.push_back(i);
    }
  }
  for (const std::uint32_t light : lights) {
    if (light >= scene.lights.size()) {
      return fail(ErrorCode::kUsage, "there is no light " + std::to_string(light),
                  "an index below " + std::to_string(scene.lights.size()));
    }
    if (scene.lights[light].type == LightType::kArea) {
      return fail(ErrorCode::kUsage, "light " + std::to_string(light) + " is an area light",
                  "a point or directional light");
    }
  }
  if (!(options.thickness >= 0) || options.thickness >= 1) {
    return fail(ErrorCode::kUsage, "plane thickness " + std::to_string(options.thickness),
                "a fraction of the scene's diagonal, 0 <= thickness < 1");
  }
  return lights;
}

Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options) {
  const Expected<std::vector<std::uint32_t>> selected = select_lights(scene, options);
  if (!selected) return tl::unexpected<Error>(selected.error());
  const std::vector<std::uint32_t>& lights = *selected;
  switch (options.kernel) {
    case KernelId::kFloat:
      return shadows_float(scene, options, lights);
    case KernelId::kDouble:
      return shadows_double(scene, options, lights);
    case KernelId::kLongDouble:
      return shadows_long_double(scene, options, lights);
    case KernelId::kEpick:
      return shadows_epick(scene, options, lights);
    case KernelId::kEpeck:
      return shadows_epeck(scene, options, lights);
    case KernelId::kRational:
      return shadows_rational(scene, options, lights);
    case KernelId::kPlane:
      return shadows_plane(scene, options, lights);
  }
  return fail(ErrorCode::kUsage, "unknown kernel");
}

}  // namespace gnomon
