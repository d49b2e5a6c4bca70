// SPDX-License-Identifier: LGPL-3.0-or-later
// One light by the SVBSP method (Chin & Feiner 1989, sec. 4): the pieces of a scene BSP front to
// back, filtered down a tree of shadow planes that grows with them. The finished tree still
// classifies whatever else lies in these pieces, as it did when their turn came.
#ifndef GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H
#define GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/light_groups.h"
#include "algorithms/lights/light_sink.h"
#include "algorithms/lights/pipeline.h"
#include "algorithms/svbsp/balanced_prefix.h"
#include "algorithms/svbsp/convex_merge.h"
#include "algorithms/svbsp/svbsp.h"
#include "algorithms/svbsp/svbsp.inl.h"

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

  /// Classifies all pieces, and grows the tree from them. `progress(done)` gets the number of nodes
  /// done.
  template <class Progress>
  RunOutcome grow(const SceneBsp<SceneVertex>& bsp, const Progress& progress) {
    return grow(bsp, progress,
                [&](std::span<const std::uint32_t> group) { filter_group(bsp, group); });
  }

  /// The same, but the tree grows from the fragments that the lights so far have left of the
  /// pieces, and which this light, `run`, classifies here (the plain form of 1989, sec. 5).
  template <class Progress>
  RunOutcome grow_from_fragments(const SceneBsp<SceneVertex>& bsp, Pipeline<Space>& pipeline,
                                 std::uint32_t run, bool is_last, const Progress& progress) {
    return grow(bsp, progress, [&](std::span<const std::uint32_t> group) {
      filter_group_of_fragments(bsp, group, pipeline, run, is_last);
    });
  }

  /// Classifies what the lights so far have left of the pieces by this light, `run`. Requires: the
  /// tree is finished.
  template <class Progress>
  RunOutcome classify(const SceneBsp<SceneVertex>& bsp, Pipeline<Space>& pipeline,
                      std::uint32_t run, bool is_last, const Progress& progress) {
    // Planes of edges that other lights cut are needed as long as they are tested.
    const std::uint32_t mark = light_.space.plane_mark();
    const std::uint64_t vanished_before = tree_.vanished();
    std::uint32_t number = 0;
    const RunOutcome outcome =
        for_each_group(light_, bsp, progress, [&](std::span<const std::uint32_t> group) {
          ++number;
          for (const std::uint32_t piece : group) {
            if (whole_[piece] != Whole::kCut) {
              pipeline.classify_all(piece, side_of(bsp, piece), run, whole_[piece] == Whole::kLit);
              continue;
            }
            pipeline.filter(piece, side_of(bsp, piece), run, is_last,
                            [&](const auto& loop, auto& output) {
                              light_.clip_to_region(loop, output, [&](const auto& inside) {
                                tree_.classify(inside, number, output);
                              });
                            });
          }
          return RunOutcome::kDone;
        });
    light_.space.release_planes(mark);
    vanished_in_pipeline_ = tree_.vanished() - vanished_before;
    return outcome;
  }

  /// What the tree takes.
  std::uint64_t tree_bytes() const { return tree_.bytes(); }
  /// Loops that vanished in the last classify() (rounded kernels).
  std::uint64_t vanished_in_pipeline() const { return vanished_in_pipeline_; }

  /// The result of this light alone. Once, when the tree is finished and before classify().
  LightResult finish(const SceneBsp<SceneVertex>& bsp) {
    LightResult result;
    result.tree_nodes = tree_.node_count();
    result.dropped_slivers = tree_.vanished() + bsp.vanished;
    counts_[Counter::kNodes] = tree_.node_count();
    counts_[Counter::kDepth] = tree_.depth();
    counts_[Counter::kLongestChain] = tree_.longest_chain();
    counts_[Counter::kMeanFilterDepth] = tree_.mean_filter_depth();
    counts_[Counter::kTreeBytes] = tree_.bytes();
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

 private:
  /// What became of a piece: all of it is in one cell, as are then all fragments of it.
  enum class Whole : std::uint8_t { kCut, kLit, kDark };

  template <class Progress, class Filter>
  RunOutcome grow(const SceneBsp<SceneVertex>& bsp, const Progress& progress,
                  const Filter& filter_one) {
    whole_.assign(bsp.pieces.size(), Whole::kCut);
    if (light_.options.prefix) {
      tree_.plant(plan_prefix(light_.scene, light_.light_point(), light_.facing.parts));
    }
    return for_each_group(light_, bsp, progress, [&](std::span<const std::uint32_t> group) {
      tree_.begin_group();
      counts_[Counter::kScenePieces] += group.size();
      filter_one(group);
      return exceeds(light_.options.limits, output_.fragments.size(), tree_.node_count())
                 ? RunOutcome::kTooManyFragments
                 : RunOutcome::kDone;
    });
  }
  Side side_of(const SceneBsp<SceneVertex>& bsp, std::uint32_t piece) const {
    return light_.facing.facing[bsp.pieces[piece].part].side;
  }

  // The facing pieces of one node are coplanar: none shadows another, so all are classified before
  // any is inserted (docs: semantics; a filter that inserts one first is a classic bug).
  void filter_group(const SceneBsp<SceneVertex>& bsp, std::span<const std::uint32_t> group) {
    pieces_.clear();
    for (const std::uint32_t index : group) {
      if constexpr (kFragmentPlanes) {
        if (!keeps_facing(bsp, bsp.pieces[index])) continue;
      }
      pieces_.push_back(index);
    }
    const bool alone = pieces_.size() == 1 || !light_.rules.coplanar_classified_first;
    for (const std::uint32_t index : pieces_) {
      const LoopRange& piece = bsp.pieces[index];
      const std::size_t before = output_.fragments.size();
      // What casts is never clipped to the region, what receives is.
      const bool inside = light_.region.place(piece.part) == RegionPlace::kInside;
      filter(bsp, piece, {.classify = true, .insert = alone && inside && light_.casts(piece.part)});
      if (alone && !inside) insert(bsp, piece);
      // Without merging, trees cut what is of one class, too.
      if (light_.options.output.merge && output_.fragments.size() == before + 1) {
        const bool lit = output_.fragments.back().state == LightState::kLit;
        whole_[index] = lit ? Whole::kLit : Whole::kDark;
      }
    }
    if (alone) return;
    for (const std::uint32_t index : pieces_) insert(bsp, bsp.pieces[index]);
  }
  /// All fragments of the group are classified before any casts, as pieces are.
  void filter_group_of_fragments(const SceneBsp<SceneVertex>& bsp,
                                 std::span<const std::uint32_t> group, Pipeline<Space>& pipeline,
                                 std::uint32_t run, bool is_last) {
    std::vector<std::vector<CarriedLoop<Vertex>>> fragments;
    for (const std::uint32_t piece : group) {
      filter(bsp, bsp.pieces[piece], {.classify = true, .insert = false});
      fragments.push_back(pipeline.loops_of(piece, side_of(bsp, piece)));
      pipeline.filter(piece, side_of(bsp, piece), run, is_last,
                      [&](const auto& loop, auto& output) {
                        light_.clip_to_region(loop, output, [&](const auto& inside) {
                          tree_.filter(inside, {.classify = true, .insert = false}, output);
                        });
                      });
    }
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (!light_.casts(bsp.pieces[group[i]].part)) continue;
      for (const CarriedLoop<Vertex>& fragment : fragments[i]) {
        tree_.filter(pipeline.to_light(fragment, group[i], side_of(bsp, group[i]), run),
                     {.classify = false, .insert = true}, output_);
      }
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
  std::uint64_t vanished_in_pipeline_ = 0;
  std::vector<Whole> whole_;  // by piece
  std::vector<std::uint32_t> pieces_;
  LoopStore<Vertex> imported_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_SVBSP_RUN_H
