// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/caster_counts.h"

#include <string>
#include <vector>

#include "algorithms/run/compute.h"
#include "algorithms/run/on_every_kernel.h"
#include "algorithms/sectors/by_sectors.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon {

namespace {

template <class Kernel>
struct CountBySectors {
  static Expected<std::vector<CasterCounts>> run(const RunTask& task) {
    return BySectors<Kernel>::count(task);
  }
};

}  // namespace

Expected<std::vector<CasterCounts>> count_casters(const PreparedScene& scene,
                                                  const ShadowOptions& options) {
  const Expected<LightList> lights = select_lights(scene, options);
  if (!lights) return tl::unexpected<Error>(lights.error());
  for (const std::uint32_t light : *lights) {
    if (!scene.lights[light].has_area()) continue;
    return fail(ErrorCode::kUsage,
                "light " + std::to_string(light) +
                    " is an area light: how many casters are before it depends on the point of it",
                "point and directional lights");
  }
  if (!has_kernel(options.kernel.id)) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel.id).name) + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  ShadowOptions own = options;
  own.output = {};
  own.output.exact_fractions = options.output.exact_fractions && kernel_info(own.kernel.id).exact;
  own.control.light_done = nullptr;
  const Rules rules;
  const LightList together;
  static constexpr auto kCount = on_every_kernel<CountBySectors>();
  return kCount[static_cast<std::size_t>(own.kernel.id)]({scene, own, rules, *lights, together});
}

}  // namespace gnomon
