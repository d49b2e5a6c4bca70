// SPDX-License-Identifier: LGPL-3.0-or-later
// The SVBSP method on a rounded kernel and kernel `plane` in lock-step, up to the first decision on
// which they differ. CMake compiles it for each rounded kernel.
#ifndef GNOMON_ALGORITHMS_RUN_EXPLAIN_RUN_H
#define GNOMON_ALGORITHMS_RUN_EXPLAIN_RUN_H

#include "algorithms/run/explain_on.h"
#include "algorithms/svbsp/svbsp_run.h"
#include "kernel/implicit/implicit_light_space.h"
#include "kernel/pair/kernel_pair.h"

namespace gnomon {

template <class Kernel>
Explanation ExplainOn<Kernel>::run(const RunTask& task) {
  using Space = PairLightSpace<typename Kernel::LightSpace, ImplicitLightSpace<NoStats>>;
  const PreparedScene& scene = task.scene;
  LockStep lock_step;
  ShadowOptions options = task.options;
  options.control.interrupted = &lock_step.stop;
  const RunTask pair_task{scene, options, task.rules, task.lights, task.combined};
  const PairOptions kernel_options{options.kernel.options(), &lock_step};

  typename Space::SceneSpace scene_space(scene.geometry, kernel_options);
  std::vector<std::uint32_t> parts(scene.parts.size());
  for (std::uint32_t i = 0; i < parts.size(); ++i) parts[i] = i;
  const auto bsp = build_scene_bsp(scene_space, scene, parts, options.method.seed,
                                   options.kernel.identity, &lock_step.stop);
  if (lock_step.first) return FirstDifference{*lock_step.first, std::nullopt};
  for (const std::uint32_t light : task.lights) {
    LightScene<Space> light_scene(pair_task, scene_space, light);
    SvbspRun<Space> run(light_scene);
    if (!lock_step.first) {
      run.run(
          bsp, [](std::size_t) {}, [](std::uint32_t, Side) {});
    }
    if (lock_step.first) return FirstDifference{*lock_step.first, light};
  }
  return std::optional<FirstDifference>();
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_EXPLAIN_RUN_H
