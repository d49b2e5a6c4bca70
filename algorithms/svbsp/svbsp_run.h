// SPDX-License-Identifier: LGPL-3.0-or-later
// The SVBSP method from a prepared scene to a result: one scene BSP, and for each light the
// front-to-back order, the SVBSP tree and its output (Chin & Feiner 1989, sec. 4); lights together
// go through the pipeline of lights/pipeline.h.
#ifndef GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H
#define GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/light_groups.h"
#include "algorithms/lights/light_sink.h"
#include "algorithms/lights/pipeline.h"
#include "algorithms/svbsp/balanced_prefix.h"
#include "algorithms/svbsp/by_svbsp.h"
#include "algorithms/svbsp/convex_merge.h"
#include "algorithms/svbsp/svbsp.h"
#include "algorithms/svbsp/svbsp.inl.h"
#include "kernel/concept/kernel_model.h"

namespace gnomon {

/// One light's tree and output.
template <LightSpaceModel Space>
class SvbspRun {
 public:
  using SceneVertex = typename Space::SceneSpace::Vertex;
  using Vertex = typename Space::Vertex;

  SvbspRun(LightScene<Space>& light, const MethodOptionValues& options)
      : light_(light),
        merge_(options.merge),
        tree_(light.space,
              {light.options.output.merge, options.edges,
               static_cast<std::uint32_t>(light.scene.geometry.edges.size())},
              light.rules) {}

  /// A space whose scene space has planes of fragments (build_scene_bsp) also says on which side of
  /// one the light is.
  static constexpr bool kFragmentPlanes = requires(const Space& space, LoopView<SceneVertex> loop) {
    space.light_side_of_fragment(loop);
  };

  /// `progress(done)` gets the number of nodes done; `before_node(piece, side)` is called for each
  /// facing piece of a node before any piece of that node is inserted.
  template <class Progress, class BeforeNode>
  RunOutcome run(const SceneBsp<SceneVertex>& bsp, const Progress& progress,
                 const BeforeNode& before_node) {
    if (light_.options.prefix) {
      tree_.plant(plan_prefix(light_.scene, light_.light_point(), light_.facing.parts));
    }
    const RunOutcome outcome =
        for_each_group(light_, bsp, progress, [&](std::span<const std::uint32_t> pieces) {
          for (const std::uint32_t piece : pieces) {
            before_node(piece, light_.facing.facing[bsp.pieces[piece].part].side);
          }
          counts_[Counter::kScenePieces] += pieces.size();
          filter_group(bsp, pieces);
          return exceeds(light_.options.limits, output_.fragments.size(), tree_.node_count())
                     ? RunOutcome::kTooManyFragments
                     : RunOutcome::kDone;
        });
    vanished_ = tree_.vanished() + bsp.vanished;
    return outcome;
  }

  LightResult finish() {
    LightResult result;
    result.tree_nodes = tree_.node_count();
    result.dropped_slivers = vanished_;
    counts_[Counter::kNodes] = tree_.node_count();
    counts_[Counter::kDepth] = tree_.depth();
    counts_[Counter::kLongestChain] = tree_.longest_chain();
    counts_[Counter::kMeanFilterDepth] = tree_.mean_filter_depth();
    if constexpr (SectorSpaceModel<Space>) {
      if (merge_ == MergeOf::kConvex && light_.options.output.merge) {
        ConvexMerge<Space> merge(light_);
        counts_[Counter::kMerged] = merge.run(output_);
        result.caster_sets = merge.take_caster_sets();
      }
    }
    counts_[Counter::kShadowPolygons] = static_cast<std::uint64_t>(
        std::ranges::count(output_.fragments, LightState::kShadow, &ClassifiedLoop::state));
    result.work = counts_;
    return LightSink<Space>(light_).finish(output_, std::move(result));
  }
  SvbspTree<Space>& tree() { return tree_; }

 private:
  // The facing pieces of one node are coplanar: none shadows another, so all are classified before
  // any is inserted (docs: semantics; a filter that inserts one first is a classic bug).
  void filter_group(const SceneBsp<SceneVertex>& bsp, std::span<const std::uint32_t> group) {
    pieces_.clear();
    for (const std::uint32_t index : group) {
      const LoopRange& piece = bsp.pieces[index];
      if constexpr (kFragmentPlanes) {
        if (!keeps_facing(bsp, piece)) continue;
      }
      pieces_.push_back(piece);
    }
    const bool alone = pieces_.size() == 1 || !light_.rules.coplanar_classified_first;
    for (const LoopRange& piece : pieces_) {
      const bool whole = light_.region.place(piece.part) == RegionPlace::kInside;
      filter(bsp, piece, {.classify = true, .insert = alone && whole && light_.casts(piece.part)});
      if (alone && !whole) insert(bsp, piece);
    }
    if (alone) return;
    for (const LoopRange& piece : pieces_) {
      insert(bsp, piece);
    }
  }
  void insert(const SceneBsp<SceneVertex>& bsp, const LoopRange& piece) {
    if (light_.casts(piece.part)) filter(bsp, piece, {.classify = false, .insert = true});
  }
  void filter(const SceneBsp<SceneVertex>& bsp, const LoopRange& piece, FilterActions actions) {
    const LoopView<Vertex> loop = import(bsp, piece);
    if (!actions.classify) return tree_.filter(loop, actions, output_);
    light_.clip_to_region(loop, output_, [&](const LoopView<Vertex>& inside) {
      tree_.filter(inside, actions, output_);
    });
  }

  /// A fragment of a part that faces the light, by its own plane; one that does not is dark.
  bool keeps_facing(const SceneBsp<SceneVertex>& bsp,
                    const LoopRange& piece) requires kFragmentPlanes {
    const Part& part = light_.part(piece.part);
    if (piece.count == part.count) return true;
    const LoopView<SceneVertex> loop = bsp.loops.view(piece, part.plane);
    const Sign at_light = light_.space.light_side_of_fragment(loop);
    const Side side = light_.facing.facing[piece.part].side;
    if (at_light == (side == Side::kFront ? Sign::kPositive : Sign::kNegative)) return true;
    output_.add_shadow(import(bsp, piece), Fragment::kNoCaster);
    return false;
  }
  LoopView<Vertex> import(const SceneBsp<SceneVertex>& bsp, const LoopRange& piece) {
    const PlaneId plane = light_.plane_of(piece.part);
    imported_.clear();
    return imported_.view(light_.import(bsp.loops.view(piece, plane), imported_), plane);
  }

  LightScene<Space>& light_;
  MergeOf merge_;
  SvbspTree<Space> tree_;
  ClassifiedLoops<Vertex> output_;
  WorkCounts counts_;
  std::uint64_t vanished_ = 0;
  std::vector<LoopRange> pieces_;
  LoopStore<Vertex> imported_;
};

template <LightSpaceModel Space>
Expected<ShadowResult> compute_by_svbsp(const RunTask& task) {
  const ShadowOptions& options = task.options;
  ShadowResult result = empty_result(options);
  const double start = cpu_seconds();
  typename Space::SceneSpace scene_space(task.scene.geometry, options.kernel.options());
  std::deque<LightScene<Space>> lights;  // never moved: a run's tree refers to its space
  for (const std::uint32_t light : task.lights) lights.emplace_back(task, scene_space, light);
  const auto bsp = order_scene(task, scene_space, lights, result);
  if (!bsp) return tl::unexpected<Error>(bsp.error());
  std::deque<SvbspRun<Space>> runs;
  for (LightScene<Space>& light : lights) runs.emplace_back(light, options.method.options);
  std::optional<Pipeline<Space>> pipeline;
  if (!task.combined.empty()) {
    if (const auto few = check_light_count(runs.size()); !few) {
      return tl::unexpected<Error>(few.error());
    }
    pipeline.emplace(task.scene, lights, *bsp);
  }
  const LightProgress progress(options.control, bsp->nodes.size(), runs.size());
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    SvbspRun<Space>& run = runs[i];
    const RunOutcome outcome = run.run(
        *bsp, [&](std::size_t nodes) { progress(i, nodes); },
        [&](std::uint32_t piece, Side side) {
          if (!pipeline) return;
          pipeline->filter(piece, side, i, [&](const auto& loop, auto& output) {
            lights[i].clip_to_region(loop, output, [&](const auto& inside) {
              run.tree().filter(inside, {.classify = true, .insert = false}, output);
            });
          });
        });
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    result.stages += lights[i].space.stage_counts();
    if (!put_light(options, run.finish(), result)) {
      return stopped_by(RunOutcome::kInterrupted, options);
    }
  }
  if (pipeline) pipeline->put_out(task, result);
  result.stages += scene_space.stage_counts();
  result.shadow_seconds = cpu_seconds() - start - result.scene_bsp_seconds;
  return result;
}

template <class Kernel>
Expected<ShadowResult> BySvbsp<Kernel>::run(const RunTask& task) {
  return with_light_space<Kernel>(task.options.output.stage_counts,
                                  [&]<class Space>() { return compute_by_svbsp<Space>(task); });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H
