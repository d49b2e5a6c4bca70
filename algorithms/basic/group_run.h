// SPDX-License-Identifier: LGPL-3.0-or-later
// Slater's three systems have one loop in common (1992, sec. 3 to 5): groups of coplanar pieces,
// front to back, each piece a target first and then, if it casts, a generator of shadows. This is
// that loop for `basic` and `tiling`, which differ in which volumes a target is tested against
// (`Candidates`: AllVolumes, TileVolumes).
//
// The two phases of a group are never mixed. All pieces of a group receive before any of them
// casts: a volume must not die, and a tile must not close, while a polygon of the same plane has
// still to be shadowed by the old volume and not by the new one (docs/basic.md).
//
// Guarantee on exact kernels: fragments have the class and a witness of the definition.
#ifndef GNOMON_ALGORITHMS_BASIC_GROUP_RUN_H
#define GNOMON_ALGORITHMS_BASIC_GROUP_RUN_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/basic/volume_list.h"
#include "algorithms/lights/light_groups.h"
#include "algorithms/lights/light_sink.h"
#include "algorithms/lights/painted_shadows.h"
#include "algorithms/lights/pipeline.h"

namespace gnomon {

template <LightSpaceModel Space, class Candidates>
class GroupRun {
 public:
  using SceneVertex = typename Space::SceneSpace::Vertex;
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  template <class... Arguments>
  GroupRun(LightScene<Space>& light, const MethodOptionValues& options, Arguments... arguments)
      : light_(light),
        options_(options),
        volumes_(light),
        candidates_(light, volumes_, arguments...) {}

  /// `progress(done)` gets the number of nodes done; `with_others(piece, side)` is called for each
  /// piece when it is a target: classify() and paint() then do the same to other loops on it.
  template <class Progress, class WithOthers>
  RunOutcome run(const SceneBsp<SceneVertex>& bsp, const Progress& progress,
                 const WithOthers& with_others) {
    vanished_ = bsp.vanished;
    return for_each_group(light_, bsp, progress, [&](std::span<const std::uint32_t> group) {
      counts_[Counter::kScenePieces] += group.size();
      const bool together = light_.rules.coplanar_classified_first;
      for (std::size_t i = 0; i < group.size(); i += together ? group.size() : 1) {
        import(bsp, together ? group : group.subspan(i, 1));
        first_own_ = volumes_.size();
        if (!light_.rules.volumes_die_after_their_plane_received) {
          for (Target& target : targets_) cast(target, {.kill = true, .insert = false});
        }
        if (!light_.rules.tiles_close_after_their_plane_received) {
          for (Target& target : targets_) cast(target, {.kill = false, .insert = true});
        }
        for (Target& target : targets_) {
          receive(target);
          with_others(target.piece, light_.facing.facing[target.loop.part].side);
        }
        for (Target& target : targets_) cast(target, {.kill = true, .insert = true});
      }
      const std::size_t most = std::max(tiling_.fragments.size(), painted_.fragments.size());
      return most > light_.options.limits.fragments ? RunOutcome::kTooManyFragments
                                                    : RunOutcome::kDone;
    });
  }

  /// Puts out what becomes of a loop on the present target, and counts nothing.
  void classify(const Loop& loop, ClassifiedLoops<Vertex>& output) {
    light_.clip_to_region(loop, output,
                          [&](const Loop& inside) { classify_inside(inside, output); });
  }
  void classify_inside(const Loop& loop, ClassifiedLoops<Vertex>& output) {
    if (const VolumeId cover = find_near_uncounted(loop); cover != kNoVolume) {
      output.add_shadow(loop, volumes_.caster(cover));
    } else {
      candidates_.subtract(loop, near_, output);
    }
  }
  /// Calls put(inside) for each shadow polygon on a loop on the present target.
  template <class Put>
  void paint(const Loop& loop, const Put& put) {
    light_.clip_and_paint(loop, put, [&](const Loop& inside) { paint_inside(inside, put); });
  }
  template <class Put>
  void paint_inside(const Loop& loop, const Put& put) {
    if (find_near_uncounted(loop) != kNoVolume) {
      put(loop);
    } else {
      volumes_.paint(loop, near_, [&](VolumeId, const Loop& inside) { put(inside); });
    }
  }

  LightResult finish() {
    candidates_.count(counts_);
    LightResult result;
    result.tree_nodes = volumes_.size();
    result.dropped_slivers = vanished_ + volumes_.take_vanished() + candidates_.vanished();
    result.work = counts_;
    LightSink<Space> sink(light_);
    return overlays() ? sink.finish_overlay(tiling_, painted_, std::move(result))
                      : sink.finish(tiling_, std::move(result));
  }

 private:
  static constexpr VolumeId kNoVolume = std::numeric_limits<VolumeId>::max();
  struct Target {
    LoopRange loop;  // in group_loops_
    std::uint32_t piece = 0;
    typename Candidates::Place place;  // of the loop
    bool covered = false;
    VolumeId volume = kNoVolume;
    bool inserted = false;
  };
  struct CastSteps {
    bool kill, insert;
  };

  bool overlays() const { return options_.cover == Cover::kOverlay; }
  Loop view(const Target& target) const {
    return group_loops_.view(target.loop, light_.plane_of(target.loop.part));
  }
  void import(const SceneBsp<SceneVertex>& bsp, std::span<const std::uint32_t> group) {
    targets_.clear();
    group_loops_.clear();
    for (const std::uint32_t index : group) {
      const LoopRange& piece = bsp.pieces[index];
      Target& target = targets_.emplace_back();
      target.loop = light_.import(bsp.loops.view(piece, light_.plane_of(piece.part)), group_loops_);
      target.piece = index;
    }
    for (Target& target : targets_) target.place = candidates_.find(view(target));
  }

  /// Phase 1: what of a target is in the shadow of the volumes so far.
  void receive(Target& target) {
    const Loop loop = view(target);
    if (light_.region.place(loop.part) != RegionPlace::kInside) return receive_inside(target);
    const std::span<const VolumeId> candidates = candidates_.at(target.place);
    candidates_.count_target(candidates.size());
    const VolumeId cover = find_near(loop, candidates, counts_);
    target.covered = cover != kNoVolume;
    if (target.covered) {
      ++counts_[Counter::kCovered];
      put_out_covered(loop, cover);
    } else {
      put_out(loop);
    }
  }

  /// Of a target that is partly outside of the light's region, which casts whatever covers the
  /// rest.
  void receive_inside(const Target& target) {
    const std::size_t before = tiling_.fragments.size();
    light_.clip_to_region(view(target), tiling_, [&](const Loop& inside) {
      const std::span<const VolumeId> candidates = candidates_.at(target.place);
      candidates_.count_target(candidates.size());
      const VolumeId cover = find_near(inside, candidates, counts_);
      cover != kNoVolume ? put_out_covered(inside, cover) : put_out(inside);
    });
    if (!overlays()) return;
    for (std::size_t i = before; i < tiling_.fragments.size(); ++i) {
      const ClassifiedLoop& own = tiling_.fragments[i];
      if (own.reason == ShadowReason::kNone) continue;
      painted_.add_outside(tiling_.loops.view(own.loop, light_.plane_of(own.loop.part)));
    }
  }

  /// Finds the candidates that a loop may have something inside of, or one that holds all of it.
  VolumeId find_near(const Loop& loop, std::span<const VolumeId> candidates, WorkCounts& counts) {
    near_.clear();
    for (const VolumeId id : candidates) {
      if (id >= first_own_) continue;  // of its own plane
      ++counts[Counter::kTests];
      const ConePlace place = volumes_.place(id, loop);
      if (place == ConePlace::kInside && options_.prune) return id;
      if (place == ConePlace::kOutside) {
        ++counts[Counter::kNulled];
      } else {
        near_.push_back(id);
      }
    }
    return kNoVolume;
  }
  VolumeId find_near_uncounted(const Loop& loop) {
    WorkCounts unused;
    return find_near(loop, candidates_.at(candidates_.find(loop)), unused);
  }

  void put_out_covered(const Loop& loop, VolumeId id) {
    if (!fragment_stays(light_.space, loop, light_.rules)) return;
    tiling_.add_shadow(loop, volumes_.caster(id));
    if (overlays()) painted_.add_shadow(loop, volumes_.caster(id));
    ++counts_[Counter::kShadowPolygons];
  }

  // The areas come from pieces that tile the target, whatever is put out; what is counted is the
  // work of the cover that was asked for.
  void put_out(const Loop& loop) {
    const std::uint64_t cuts = volumes_.cuts();
    if (overlays()) {
      const std::uint64_t polygons =
          volumes_.paint(loop, near_, [&](VolumeId id, const Loop& inside) {
            painted_.add_shadow(inside, volumes_.caster(id));
          });
      counts_[Counter::kClips] += volumes_.cuts() - cuts;
      counts_[Counter::kNulled] += near_.size() - polygons;
      counts_[Counter::kShadowPolygons] += polygons;
      candidates_.subtract(loop, near_, tiling_);
      return;
    }
    const std::size_t before = tiling_.fragments.size();
    const std::uint64_t useful = candidates_.subtract(loop, near_, tiling_);
    counts_[Counter::kClips] += volumes_.cuts() - cuts;
    counts_[Counter::kNulled] += near_.size() - std::min<std::uint64_t>(useful, near_.size());
    for (std::size_t i = before; i < tiling_.fragments.size(); ++i) {
      if (tiling_.fragments[i].state == LightState::kShadow) ++counts_[Counter::kShadowPolygons];
    }
  }

  /// Phase 2: the target becomes a volume; those that it holds are no longer needed.
  void cast(Target& target, CastSteps steps) {
    if (!light_.casts(target.loop.part) || target.covered || target.inserted) return;
    if (target.volume == kNoVolume) {
      target.volume = volumes_.add(view(target));
      ++counts_[Counter::kVolumes];
    }
    const VolumeId own = target.volume;
    if (steps.kill && options_.prune) {
      for (const VolumeId other : candidates_.at(target.place)) {
        if (other == own || !volumes_.holds(own, volumes_.loop(other))) continue;
        volumes_.kill(other);
        ++counts_[Counter::kDied];
      }
    }
    if (steps.insert) candidates_.insert(own, target.place);
    target.inserted = steps.insert;
  }

  LightScene<Space>& light_;
  const MethodOptionValues& options_;
  VolumeList<Space> volumes_;
  Candidates candidates_;
  ClassifiedLoops<Vertex> tiling_, painted_;
  WorkCounts counts_;
  std::uint64_t vanished_ = 0;
  // Workspace, kept to save allocations.
  LoopStore<Vertex> group_loops_;
  std::vector<Target> targets_;
  std::vector<VolumeId> near_;
  VolumeId first_own_ = 0;  // volumes from here on are of the group
};

/// Every light by the same scene BSP, one after another. `Arguments`: what Candidates are told
/// besides the light and the volumes.
template <LightSpaceModel Space, class Candidates, class... Arguments>
Expected<ShadowResult> compute_by_groups(const RunTask& task, Arguments... arguments) {
  const ShadowOptions& options = task.options;
  ShadowResult result = empty_result(options);
  const double start = cpu_seconds();
  typename Space::SceneSpace scene_space(task.scene.geometry, options.kernel.options());
  LightScenes<Space> lights;
  for (const std::uint32_t light : task.lights) {
    lights.push_back(std::make_unique<LightScene<Space>>(task, scene_space, light));
  }
  const auto bsp = order_scene(task, scene_space, parts_that_face(task.scene, lights), result);
  if (!bsp) return tl::unexpected<Error>(bsp.error());
  std::optional<Pipeline<Space>> pipeline;
  std::optional<PaintedShadows<Space>> painted;
  if (!task.combined.empty()) {
    if (const auto few = check_light_count(lights.size()); !few) {
      return tl::unexpected<Error>(few.error());
    }
    if (options.method.options.cover == Cover::kOverlay) {
      painted.emplace(task.scene, lights, *bsp);
    } else {
      pipeline.emplace(task.scene, lights, *bsp);
    }
  }
  const LightProgress progress(options.control, bsp->nodes.size(), lights.size());
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    GroupRun<Space, Candidates> run(*lights[i], options.method.options, arguments...);
    const RunOutcome outcome = run.run(
        *bsp, [&](std::size_t nodes) { progress(i, nodes); },
        [&](std::uint32_t piece, Side side) {
          if (pipeline) {
            pipeline->filter(piece, side, i, i + 1 == lights.size(),
                             [&](const auto& loop, auto& output) { run.classify(loop, output); });
          }
          if (painted) {
            painted->filter(piece, side, i,
                            [&](const auto& loop, const auto& put) { run.paint(loop, put); });
          }
        });
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    result.stages += lights[i]->space.stage_counts();
    if (!put_light(options, run.finish(), result)) {
      return stopped_by(RunOutcome::kInterrupted, options);
    }
  }
  if (pipeline) pipeline->put_out(task, result);
  if (painted) painted->put_out(task, result);
  result.stages += scene_space.stage_counts();
  result.shadow_seconds = cpu_seconds() - start - result.scene_bsp_seconds;
  return result;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BASIC_GROUP_RUN_H
