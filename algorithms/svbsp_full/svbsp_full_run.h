// SPDX-License-Identifier: LGPL-3.0-or-later
// The method svbsp-full from a prepared scene to a result: for each light two passes over the
// polygons that face it. Two, since a polygon that is inserted later may be nearer (1989, sec. 8).
#ifndef GNOMON_ALGORITHMS_SVBSP_FULL_SVBSP_FULL_RUN_H
#define GNOMON_ALGORITHMS_SVBSP_FULL_SVBSP_FULL_RUN_H

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/lights/light_groups.h"
#include "algorithms/lights/light_sink.h"
#include "algorithms/partition/insertion_order.h"
#include "algorithms/svbsp_full/by_svbsp_full.h"
#include "algorithms/svbsp_full/full_volume_tree.h"
#include "kernel/concept/kernel_model.h"

namespace gnomon {

template <SectorSpaceModel Space>
class SvbspFullRun {
 public:
  using Vertex = typename Space::Vertex;

  SvbspFullRun(LightScene<Space>& light, InsertionOrder order)
      : light_(light), order_(order), tree_(light) {}

  /// `progress(done)` gets the number of polygons done, each of them twice.
  template <class Progress>
  RunOutcome run(const Progress& progress) {
    import_parts();
    if (light_.options.prefix) {
      tree_.plant(plan_prefix(light_.scene, light_.light_point(), light_.facing.parts));
    }
    const std::vector<std::uint32_t> order =
        in_order(order_, light_.scene, light_.light_point(), light_.facing.parts);
    const std::uint32_t mark = light_.space.plane_mark();
    std::size_t done = 0;
    for (const std::uint32_t part : order) {
      if (const RunOutcome outcome = check(done); outcome != RunOutcome::kDone) return outcome;
      progress(done++);
      if (!light_.casts(part)) continue;
      ++counts_[Counter::kVolumes];
      tree_.insert(view(part));
      light_.space.release_planes(mark);  // cuts by support planes are no nodes
    }
    for (const std::uint32_t part : light_.facing.parts) {
      if (const RunOutcome outcome = check(done); outcome != RunOutcome::kDone) return outcome;
      progress(done++);
      light_.clip_to_region(view(part), output_, [&](const LoopView<Vertex>& inside) {
        tree_.classify(inside, output_);
      });
    }
    return check(0);
  }

  LightResult finish() {
    LightResult result;
    result.tree_nodes = tree_.node_count();
    result.dropped_slivers = tree_.vanished();
    counts_[Counter::kNodes] = tree_.node_count();
    counts_[Counter::kDepth] = tree_.depth();
    counts_[Counter::kShadowPolygons] = static_cast<std::uint64_t>(
        std::ranges::count(output_.fragments, LightState::kShadow, &ClassifiedLoop::state));
    result.work = counts_;
    return LightSink<Space>(light_).finish(output_, std::move(result));
  }

 private:
  void import_parts() {
    ranges_.resize(light_.scene.parts.size());
    for (const std::uint32_t part : light_.facing.parts) {
      ranges_[part] = light_.with_edge_planes(light_.import_part(part, loops_), loops_);
    }
  }
  LoopView<Vertex> view(std::uint32_t part) const {
    return loops_.view(ranges_[part], light_.plane_of(part));
  }
  RunOutcome check(std::size_t done) const {
    const std::atomic<bool>* interrupted = light_.options.interrupted;
    if (done % 64 == 0 && interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) {
      return RunOutcome::kInterrupted;
    }
    return exceeds(light_.options.limits, output_.fragments.size(), tree_.node_count())
               ? RunOutcome::kTooManyFragments
               : RunOutcome::kDone;
  }

  LightScene<Space>& light_;
  InsertionOrder order_;
  FullVolumeTree<Space> tree_;
  LoopStore<Vertex> loops_;        // of all facing parts; their edges are shadow planes
  std::vector<LoopRange> ranges_;  // by part
  ClassifiedLoops<Vertex> output_;
  WorkCounts counts_;
};

template <SectorSpaceModel Space>
Expected<ShadowResult> compute_by_svbsp_full(const RunTask& task) {
  const ShadowOptions& options = task.options;
  ShadowResult result = empty_result(options);
  const double start = cpu_seconds();
  typename Space::SceneSpace scene_space(task.scene.geometry, options.kernel.options());
  for (std::size_t i = 0; i < task.lights.size(); ++i) {
    LightScene<Space> light(task, scene_space, task.lights[i]);
    SvbspFullRun<Space> run(light, options.method.options.order);
    const LightProgress progress(options.control,
                                 std::max<std::size_t>(1, 2 * light.facing.parts.size()),
                                 task.lights.size());
    const RunOutcome outcome = run.run([&](std::size_t done) { progress(i, done); });
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    if (!put_light(options, run.finish(), result)) {
      return stopped_by(RunOutcome::kInterrupted, options);
    }
    result.stages += light.space.stage_counts();
  }
  result.stages += scene_space.stage_counts();
  result.shadow_seconds = cpu_seconds() - start;
  return result;
}

template <class Kernel>
Expected<ShadowResult> BySvbspFull<Kernel>::run(const RunTask& task) {
  return with_light_space<Kernel>(task.options.output.stage_counts, [&]<class Space>() {
    return compute_by_svbsp_full<Space>(task);
  });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_FULL_SVBSP_FULL_RUN_H
