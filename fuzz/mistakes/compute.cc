// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/mistakes/compute.h"

#include <algorithm>
#include <string>

#include "algorithms/run/compute.h"
#include "algorithms/run/compute_pixels.h"
#include "algorithms/shading_mesh/mesh_by_rules.h"
#include "fuzz/mistakes/mutant_kernels.h"

namespace gnomon::fuzz {

namespace {

/// The thickness of kThicknessTooLarge.
constexpr double kTooThick = 0x1p-7;

/// Refuses a mistake that would do nothing, or that nobody has thought about.
Expected<void> check_mistake(const PreparedScene& scene, const ShadowOptions& options,
                             const LightList& lights, Mistake mistake) {
  const std::string name = "mutation " + std::string(name_of(mistake));
  if (options.output.combined && !is_of_lights_together(mistake))
    return fail(ErrorCode::kUsage, name + " of lights together", "one by one");
  if (mistake == Mistake::kThicknessTooSmall && options.kernel.thickness == 0) {
    return fail(ErrorCode::kUsage, name + " of planes that have no thickness", "a thickness");
  }
  const bool applies = std::ranges::any_of(lights, [&](std::uint32_t light) {
    const LightType type = scene.lights[light].type;
    const MethodId method = method_of(type, options, false);
    return type == LightType::kArea ? applies_to_area(mistake, options.kernel.id, method)
                                    : applies_to(mistake, options.kernel.id, method);
  });
  if (applies) return {};
  return fail(ErrorCode::kUsage, name + " changes nothing",
              "a kernel, an algorithm and a light that it applies to (docs/bug-zoo.md)");
}

MethodLookup kernels_of(Mistake mistake) {
  switch (mistake) {
    case Mistake::kPlanesFromFragments:
      return planes_from_fragments_function;
    case Mistake::kVerticesPerSide:
      return vertices_per_side_function;
    default:
      return method_function;
  }
}

}  // namespace

Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options,
                                       Mistake mistake) {
  if (mistake == Mistake::kNone) return gnomon::compute_shadows(scene, options);
  const Expected<LightList> lights = select_lights(scene, options);
  if (!lights) return tl::unexpected(lights.error());
  if (const auto checked = check_mistake(scene, options, *lights, mistake); !checked) {
    return tl::unexpected(checked.error());
  }
  ShadowOptions own = options;
  if (mistake == Mistake::kThicknessTooLarge) own.kernel.thickness = kTooThick;
  if (mistake == Mistake::kThicknessTooSmall) own.kernel.thickness = 0;
  return compute_with(scene, own, rules_of(mistake), kernels_of(mistake));
}

Expected<Pixels> compute_pixels(const PreparedScene& scene, const ImageFrame& frame,
                                const PixelOptions& options, Mistake mistake) {
  if (!applies_to(mistake, options.kernel.id, options.method)) {
    return fail(ErrorCode::kUsage, "mutation " + std::string(name_of(mistake)) + " changes nothing",
                "a method that it applies to (docs/bug-zoo.md)");
  }
  return compute_pixels_with(scene, frame, options, rules_of(mistake));
}

Expected<ShadingMesh> make_shading_mesh(const PreparedScene& scene, const ShadowResult& result,
                                        const ShadeFunction& shade, const ShadingOptions& options,
                                        Mistake mistake) {
  return make_shading_mesh_by(scene, result, shade, options, rules_of(mistake));
}

}  // namespace gnomon::fuzz
