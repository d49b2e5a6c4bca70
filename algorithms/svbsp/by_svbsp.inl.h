// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of by_svbsp.h, instantiated one kernel a source: lights one by one, each by its own tree,
// or several together, perhaps step by step while some of them move (lights_in_turn.h).
#ifndef GNOMON_ALGORITHMS_SVBSP_BY_SVBSP_INL_H
#define GNOMON_ALGORITHMS_SVBSP_BY_SVBSP_INL_H

#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "algorithms/svbsp/by_svbsp.h"
#include "algorithms/svbsp/lights_in_turn.h"
#include "algorithms/svbsp/svbsp_run.h"
#include "kernel/concept/kernel_model.h"

namespace gnomon {

/// Fragments of fragments have planes of unbounded degree, which the kernel `plane` cannot have.
template <LightSpaceModel Space>
Expected<void> check_growth(const ShadowOptions& options) {
  if (options.method.options.grow == GrowFrom::kPolygons || !options.output.combined) return {};
  if constexpr (LightsInTurn<Space>::kGrowsFromFragments) {
    return {};
  } else {
    return fail(ErrorCode::kUsage,
                "grow=fragments on kernel " + std::string(kernel_info(options.kernel.id).name) +
                    ": shadow planes through edges that other shadow planes cut have no bounded "
                    "degree",
                "grow=polygons, or a kernel that constructs its vertices (rational, epeck, double, "
                "...)");
  }
}

/// Lights one by one: a scene BSP of the parts that they need, then a tree a light.
template <LightSpaceModel Space>
Expected<ShadowResult> compute_one_by_one(const RunTask& task,
                                          typename Space::SceneSpace& scene_space) {
  const ShadowOptions& options = task.options;
  ShadowResult result = empty_result(options);
  const double start = cpu_seconds();
  LightScenes<Space> lights;
  for (const std::uint32_t light : task.lights) {
    lights.push_back(std::make_unique<LightScene<Space>>(task, scene_space, light));
  }
  const auto bsp = order_scene(task, scene_space, parts_that_face(task.scene, lights), result);
  if (!bsp) return tl::unexpected<Error>(bsp.error());
  const LightProgress progress(options.control, bsp->nodes.size(), lights.size());
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    SvbspRun<Space> run(*lights[i], options.method.options);
    const RunOutcome outcome = run.grow(*bsp, [&](std::size_t nodes) { progress(i, nodes); });
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    result.stages += lights[i]->space.stage_counts();
    if (!put_light(options, run.finish(*bsp), result)) {
      return stopped_by(RunOutcome::kInterrupted, options);
    }
  }
  result.shadow_seconds = cpu_seconds() - start - result.scene_bsp_seconds;
  return result;
}

/// Lights together, at their places and at those of all steps.
template <LightSpaceModel Space>
Expected<ShadowResult> compute_together(const RunTask& task,
                                        typename Space::SceneSpace& scene_space) {
  const ShadowOptions& options = task.options;
  ShadowResult common = empty_result(options);
  common.algorithm = method_text(MethodId::kSvbsp, options.method.options);
  double start = cpu_seconds();
  // All parts: which of them face a light is another question at each step, and the steps have
  // one order in common.
  std::vector<std::uint32_t> parts(task.scene.parts.size());
  std::iota(parts.begin(), parts.end(), 0u);
  const auto bsp = order_scene(task, scene_space, parts, common);
  if (!bsp) return tl::unexpected<Error>(bsp.error());
  LightsInTurn<Space> lights(task, scene_space, *bsp);
  for (std::size_t step = 0;; ++step) {
    ShadowResult result = common;
    const RunOutcome outcome = lights.run_step(step, result);
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    result.shadow_seconds = cpu_seconds() - start;
    if (step == 0) result.shadow_seconds -= result.scene_bsp_seconds;
    start = cpu_seconds();
    if (options.steps.empty()) return result;
    if (!options.control.step_done(result)) return stopped_by(RunOutcome::kInterrupted, options);
    lights.take_back(std::move(result.lights));
    if (step == options.steps.size()) return common;
  }
}

template <LightSpaceModel Space>
Expected<ShadowResult> compute_by_svbsp(const RunTask& task) {
  if (const auto checked = check_growth<Space>(task.options); !checked) {
    return tl::unexpected<Error>(checked.error());
  }
  typename Space::SceneSpace scene_space(task.scene.geometry, task.options.kernel.options());
  Expected<ShadowResult> result = task.combined.empty()
                                      ? compute_one_by_one<Space>(task, scene_space)
                                      : compute_together<Space>(task, scene_space);
  if (result) result->stages += scene_space.stage_counts();
  return result;
}

template <class Kernel>
Expected<ShadowResult> BySvbsp<Kernel>::run(const RunTask& task) {
  return with_light_space<Kernel>(task.options.output.stage_counts,
                                  [&]<class Space>() { return compute_by_svbsp<Space>(task); });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_BY_SVBSP_INL_H
