// SPDX-License-Identifier: LGPL-3.0-or-later
// The SVBSP method from a prepared scene to a result: one scene BSP, and for each light the
// front-to-back order, the SVBSP tree and its output (Chin & Feiner 1989, sec. 4); lights together
// go through the pipeline of many_lights.h.
#ifndef GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H
#define GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/fractions.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/scene_bsp/scene_bsp.h"
#include "algorithms/scene_bsp/scene_bsp.inl.h"
#include "algorithms/svbsp/balanced_prefix.h"
#include "algorithms/svbsp/by_svbsp.h"
#include "algorithms/svbsp/many_lights.h"
#include "algorithms/svbsp/svbsp.h"
#include "algorithms/svbsp/svbsp.inl.h"
#include "kernel/concept/kernel_model.h"

namespace gnomon {

/// One light's computation: its space, tree and output.
template <LightSpaceModel Space>
class SvbspRun {
 public:
  using SceneSpace = typename Space::SceneSpace;
  using SceneVertex = typename SceneSpace::Vertex;
  using Vertex = typename Space::Vertex;

  SvbspRun(const PreparedScene& scene, const RunOptions& options, const Rules& rules,
           SceneSpace& scene_space, std::uint32_t light, const KernelOptions& kernel_options)
      : scene_(scene),
        options_(options),
        rules_(rules),
        scene_space_(scene_space),
        space_(scene_space, scene.lights[light].point, kernel_options),
        facing_(scene, space_, rules),
        tree_(space_, options.output.merge, rules) {
    result_.light = light;
    result_.facing_parts = facing_.parts.size();
    result_.facing_edges = facing_.edges;
  }

  const std::vector<std::uint32_t>& facing_parts() const { return facing_.parts; }

  /// The tree is smaller than a fragment's loop; this keeps it from outgrowing them.
  static constexpr std::uint64_t kMostNodesAFragment = 8;
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
    if (options_.prefix) {
      tree_.plant(plan_prefix(scene_, scene_.lights[result_.light].point, facing_.parts));
    }
    const std::vector<std::uint32_t> order = front_to_back(bsp.nodes, [&](PlaneId plane) {
      const std::vector<Sign>& known = facing_.plane_signs;  // of the parts' planes
      return plane < known.size() ? known[plane] : space_.light_side(plane);
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      if ((i & 63) == 0) {
        if (options_.interrupted != nullptr &&
            options_.interrupted->load(std::memory_order_relaxed)) {
          return RunOutcome::kInterrupted;
        }
        progress(i);
      }
      const BspNode& node = bsp.nodes[order[i]];
      for (std::uint32_t k = 0; k < node.count; ++k) {
        const std::uint32_t piece = bsp.node_pieces[node.first + k];
        const Facing& facing = facing_.facing[bsp.pieces[piece].part];
        if (facing.faces()) before_node(piece, facing.side);
      }
      filter_node(bsp, node);
      if (output_.fragments.size() > options_.limits.fragments ||
          tree_.node_count() / kMostNodesAFragment > options_.limits.fragments) {
        return RunOutcome::kTooManyFragments;
      }
    }
    result_.tree_nodes = tree_.node_count();
    result_.dropped_slivers = tree_.vanished() + bsp.vanished;
    return RunOutcome::kDone;
  }

  /// Groups fragments by part, collapses parts that agree, measures and exports.
  LightResult finish();
  StageCounts stage_counts() const { return space_.stage_counts(); }
  Space& space() { return space_; }
  SvbspTree<Space>& tree() { return tree_; }

 private:
  // The facing pieces of one node are coplanar: none shadows another, so all are classified before
  // any is inserted (docs: semantics; a filter that inserts one first is a classic bug).
  void filter_node(const SceneBsp<SceneVertex>& bsp, const BspNode& node) {
    pieces_.clear();
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const LoopRange& piece = bsp.pieces[bsp.node_pieces[node.first + i]];
      if (!facing_.facing[piece.part].faces()) continue;
      if constexpr (kFragmentPlanes) {
        if (!keeps_facing(bsp, piece)) continue;
      }
      pieces_.push_back(piece);
    }
    const bool alone = pieces_.size() == 1 || !rules_.coplanar_classified_first;
    for (const LoopRange& piece : pieces_) {
      const Part& part = scene_.parts[piece.part];
      import(bsp.loops.view(piece, part.plane));
      tree_.filter(imported_.view({0, imported_.size(), piece.part}, part.plane),
                   {.classify = true, .insert = alone && part.casts}, output_);
    }
    if (alone) return;
    for (const LoopRange& piece : pieces_) {
      const Part& part = scene_.parts[piece.part];
      if (!part.casts) continue;
      import(bsp.loops.view(piece, part.plane));
      tree_.filter(imported_.view({0, imported_.size(), piece.part}, part.plane),
                   {.classify = false, .insert = true}, output_);
    }
  }

  /// A fragment of a part that faces the light, by its own plane; one that does not is dark.
  bool keeps_facing(const SceneBsp<SceneVertex>& bsp,
                    const LoopRange& piece) requires kFragmentPlanes {
    const Part& part = scene_.parts[piece.part];
    if (piece.count == part.count) return true;
    const LoopView<SceneVertex> loop = bsp.loops.view(piece, part.plane);
    const Sign at_light = space_.light_side_of_fragment(loop);
    const Side side = facing_.facing[piece.part].side;
    if (at_light == (side == Side::kFront ? Sign::kPositive : Sign::kNegative)) return true;
    import(loop);
    output_.fragments.push_back(
        {output_.loops.append(imported_.view({0, imported_.size(), piece.part}, part.plane)),
         LightState::kShadow, Fragment::kNoCaster});
    return false;
  }
  void import(const LoopView<SceneVertex>& loop) {
    imported_.resize(loop.size());
    import_loop(space_, loop, facing_.facing[loop.part].side == Side::kBack, imported_, 0);
  }
  void import_part(std::uint32_t index) { import(part_loop(scene_space_, scene_, index, whole_)); }
  void measure(PartResult& part, std::span<const ClassifiedLoop> fragments);

  const PreparedScene& scene_;
  const RunOptions& options_;
  Rules rules_;
  SceneSpace& scene_space_;
  Space space_;
  FacingParts facing_;
  SvbspTree<Space> tree_;
  SvbspOutput<Vertex> output_;
  std::vector<LoopRange> pieces_;
  LoopStore<Vertex> imported_;
  LoopStore<SceneVertex> whole_;
  LightResult result_;
};

template <LightSpaceModel Space>
LightResult SvbspRun<Space>::finish() {
  // Counting sort by part: fragments of one part may come from several nodes.
  std::vector<std::uint32_t> start(scene_.parts.size() + 1, 0);
  for (const ClassifiedLoop& f : output_.fragments) ++start[f.loop.part + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<ClassifiedLoop> sorted(output_.fragments.size());
  {
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (const ClassifiedLoop& f : output_.fragments) sorted[next[f.loop.part]++] = f;
  }
  output_.fragments = {};
  const bool keep = options_.keeps_any_points();
  result_.parts.reserve(scene_.parts.size());
  for (std::uint32_t index = 0; index < scene_.parts.size(); ++index) {
    PartResult part;
    part.part = index;
    part.side = facing_.facing[index].side;
    part.reason = facing_.facing[index].reason;
    part.first_fragment = static_cast<std::uint32_t>(result_.fragments.size());
    std::span<ClassifiedLoop> own(sorted.data() + start[index], start[index + 1] - start[index]);
    if (options_.output.merge && own.size() > 1) {
      const bool agree = std::all_of(own.begin(), own.end(), [&](const ClassifiedLoop& f) {
        return f.state == own[0].state && f.caster == own[0].caster;
      });
      if (agree) {  // the input polygon as it was (1989, sec. 6)
        import_part(index);
        const LoopView<Vertex> whole =
            imported_.view({0, imported_.size(), index}, scene_.parts[index].plane);
        own[0].loop = output_.loops.append(whole);
        own = own.first(1);
      }
    }
    part.fragment_count = static_cast<std::uint32_t>(own.size());
    result_.fragment_total += own.size();
    measure(part, own);
    for (const ClassifiedLoop& f : own) {
      Fragment fragment;
      fragment.state = f.state;
      fragment.caster = f.caster;
      if (keep) {
        export_loop(space_, scene_.geometry, options_,
                    output_.loops.view(f.loop, scene_.parts[index].plane), fragment, result_.points,
                    result_.exact_points);
      }
      result_.fragments.push_back(fragment);
    }
    result_.parts.push_back(std::move(part));
  }
  return std::move(result_);
}

template <LightSpaceModel Space>
void SvbspRun<Space>::measure(PartResult& part, std::span<const ClassifiedLoop> fragments) {
  part.lit = {0, 0};
  part.shadow = {1, 1};
  part.exact_shadow = 1;
  if (part.reason != ShadowReason::kNone || fragments.empty()) return;
  if (fragments.size() == 1) {  // fragments tile the part
    if (fragments[0].state == LightState::kLit) {
      std::swap(part.lit, part.shadow);
      std::swap(part.exact_lit, part.exact_shadow);
    }
    return;
  }
  const PlaneId plane = scene_.parts[part.part].plane;
  const Chart chart = chart_of(scene_.geometry, plane);
  import_part(part.part);
  const LoopView<Vertex> whole = imported_.view({0, imported_.size(), part.part}, plane);
  PartMeasure<Space> measure_part(space_, chart, whole, options_.output.exact_fractions);
  FractionSum lit, shadow;
  for (const ClassifiedLoop& f : fragments) {
    (f.state == LightState::kLit ? lit : shadow)
        .add(measure_part.fraction(output_.loops.view(f.loop, plane)));
  }
  part.lit = lit.interval(Space::kExact);
  part.shadow = shadow.interval(Space::kExact);
  if (options_.output.exact_fractions) {
    part.exact_lit = lit.exact();
    part.exact_shadow = shadow.exact();
  }
}

template <LightSpaceModel Space>
Expected<ShadowResult> compute_by_svbsp(const RunTask& task) {
  using SceneSpace = typename Space::SceneSpace;
  const PreparedScene& scene = task.scene;
  const ShadowOptions& options = task.options;
  const LightList& lights = task.lights;
  ShadowResult result = empty_result(options);

  const double start = cpu_seconds();
  const KernelOptions kernel_options = options.kernel.options();
  const RunOptions run_options = run_options_of(options);
  SceneSpace scene_space(scene.geometry, kernel_options);
  std::deque<SvbspRun<Space>> runs;  // never moved: a run's tree refers to its space
  std::vector<bool> needed(scene.parts.size(), false);
  for (const std::uint32_t light : lights) {
    runs.emplace_back(scene, run_options, task.rules, scene_space, light, kernel_options);
    for (const std::uint32_t part : runs.back().facing_parts()) needed[part] = true;
  }
  // Only what faces some light has to be in order.
  std::vector<std::uint32_t> parts;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    if (needed[i]) parts.push_back(i);
  }
  const SceneBsp<typename SceneSpace::Vertex> bsp =
      build_scene_bsp(scene_space, scene, parts, options.method.seed, result.identity,
                      options.control.interrupted, options.limits.fragments, task.rules);
  if (bsp.interrupted) return stopped_by(RunOutcome::kInterrupted, options);
  result.scene_bsp_seconds = cpu_seconds() - start;
  result.bsp_nodes = bsp.nodes.size();
  result.bsp_depth = bsp.depth;
  for (const BspNode& node : bsp.nodes) result.bsp_fragments += node.count;

  if (bsp.too_many) return stopped_by(RunOutcome::kTooManyFragments, options);
  std::optional<Pipeline<Space>> pipeline;
  if (!task.combined.empty()) {
    if (runs.size() > 64) {
      return fail(ErrorCode::kLimit, std::to_string(runs.size()) + " lights together",
                  "at most 64");
    }
    pipeline.emplace(scene, scene_space, bsp);
    for (SvbspRun<Space>& run : runs) pipeline->add_space(run.space());
  }
  const double total = static_cast<double>(bsp.nodes.size()) * static_cast<double>(runs.size());
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    SvbspRun<Space>& run = runs[i];
    const double before = static_cast<double>(bsp.nodes.size()) * i;
    const auto outcome = run.run(
        bsp,
        [&](std::size_t nodes) {
          if (options.control.progress)
            options.control.progress((before + static_cast<double>(nodes)) / total);
        },
        [&](std::uint32_t piece, Side side) {
          if (pipeline) pipeline->filter(piece, side, i, run.tree());
        });
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    result.stages += run.stage_counts();
    result.lights.push_back(run.finish());
  }
  if (pipeline) {
    pipeline->for_each([&](std::uint32_t part, Side side, std::uint64_t lit_by, const Space& space,
                           const LoopView<typename Space::Vertex>& loop) {
      CombinedFragment fragment{part, side, lit_by};
      export_loop(space, scene.geometry, run_options, loop, fragment, result.combined_points,
                  result.combined_exact_points);
      result.combined.push_back(fragment);
    });
    const auto key = [&](const CombinedFragment& fragment) {
      return std::pair(scene.parts[fragment.part].polygon, -static_cast<int>(fragment.side));
    };
    std::stable_sort(
        result.combined.begin(), result.combined.end(),
        [&](const CombinedFragment& a, const CombinedFragment& b) { return key(a) < key(b); });
  }
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
