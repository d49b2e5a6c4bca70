// SPDX-License-Identifier: LGPL-3.0-or-later
// Lights of any kind receiver by receiver, from a prepared scene to a result, on several threads;
// and several lights in one pipeline, with a class per light on each fragment. A receiver is cut by
// the volumes that reach it, or filtered down the light's volume trees where the method has them.
#ifndef GNOMON_ALGORITHMS_RUN_RECEIVER_RUN_H
#define GNOMON_ALGORITHMS_RUN_RECEIVER_RUN_H

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <iterator>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/area_contour/light_volumes.h"
#include "algorithms/area_contour/receiver_shares.h"
#include "algorithms/partition/fragment_sink.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/run_options.h"
#include "algorithms/run/by_receiver.h"
#include "algorithms/scene_bsp/scene_bsp.inl.h"
#include "algorithms/shadow_volumes/caster_tree.h"
#include "algorithms/shadow_volumes/light_geometry.h"
#include "algorithms/shadow_volumes/light_in_space.h"
#include "algorithms/volume_trees/filtered_sides.h"
#include "algorithms/volume_trees/interleaved_order.h"
#include "algorithms/volume_trees/light_by_planes.h"
#include "algorithms/volume_trees/penumbra_and_umbra.h"
#include "gnomon/algorithms/components.h"
#include "kernel/concept/kernel_model.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

/// What a thread needs for one receiver after another, by any of the algorithms.
template <VolumeSpaceModel Space>
struct ReceiverRunWorkspace : ReceiverWorkspace<Space> {
  using ReceiverWorkspace<Space>::ReceiverWorkspace;

  std::unique_ptr<VolumeTreeWorkspace<Space>> trees;  // once a light has trees
  area_contour::ContourOf<Space> contour;
  std::uint64_t open = 0;  // sides that the contour has left open
};

template <VolumeSpaceModel Space>
class ReceiverRun {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;
  using Workspace = ReceiverRunWorkspace<Space>;
  using SceneSpace = typename Space::SceneSpace;

  ReceiverRun(const PreparedScene& scene, const ShadowOptions& options, const Rules& rules)
      : scene_(scene),
        options_(options),
        run_options_(run_options_of(options)),
        rules_(rules),
        light_geometry_(make_light_geometry(scene)),
        scene_space_(light_geometry_.geometry, options.kernel.options()),
        space_(scene_space_, options.kernel.options()),
        tree_(light_geometry_.geometry, scene, casters(scene), options.tuning.jobs) {
    if (options.method.options.casters == CastersAre::kSolids) find_solids();
    if (makes_contours() && rules.straddling_light_is_cut &&
        std::ranges::any_of(scene.lights, &PreparedLight::has_area)) {
      find_shells();
    }
  }

  /// Lights that results are wanted of one by one, and those that fragments are combined of.
  Expected<ShadowResult> run(const LightList& lights, const LightList& combined);

 private:
  using Workspaces = tbb::enumerable_thread_specific<std::unique_ptr<Workspace>>;

  static std::vector<std::uint32_t> casters(const PreparedScene& scene) {
    std::vector<std::uint32_t> parts;
    const bool all = std::ranges::any_of(scene.lights, &PreparedLight::is_eye);
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
      if (all || scene.parts[i].casts) parts.push_back(i);
    }
    return parts;
  }
  void find_solids() {
    solids_.of_part.assign(scene_.parts.size(), SolidCasters::kNone);
    for (Component& component : find_components(scene_)) {
      const auto casts = [&](std::uint32_t part) { return scene_.parts[part].casts; };
      if (!component.is_convex || !std::ranges::all_of(component.parts, casts)) continue;
      for (const std::uint32_t part : component.parts) {
        solids_.of_part[part] = static_cast<std::uint32_t>(solids_.solids.size());
      }
      solids_.solids.push_back(std::move(component.parts));
    }
  }
  void find_shells() {
    // Larger ones have so many planes that their faces are sooner told apart.
    constexpr std::uint32_t kMostFaces = 128;
    shells_.of_part.assign(scene_.parts.size(), ShellCasters::kNone);
    for (ConvexShell& shell : find_convex_shells(scene_, kMostFaces, jobs())) {
      const auto casts = [&](std::uint32_t part) { return scene_.parts[part].casts; };
      if (!std::ranges::all_of(shell.parts, casts)) continue;
      for (const std::uint32_t part : shell.parts) {
        shells_.of_part[part] = static_cast<std::uint32_t>(shells_.shells.size());
      }
      shells_.shells.push_back(std::move(shell));
    }
  }
  unsigned jobs() const { return Space::kParallel ? options_.tuning.jobs : 1; }
  const SolidCasters* solids() const { return solids_.solids.empty() ? nullptr : &solids_; }
  const ShellCasters* shells() const { return shells_.shells.empty() ? nullptr : &shells_; }
  /// Calls body(workspace, i) for [0, n). False if it was stopped.
  template <class Body>
  bool for_each(std::size_t n, double from, double to, const Body& body);
  bool stopped() {
    if (options_.control.interrupted != nullptr &&
        options_.control.interrupted->load(std::memory_order_relaxed)) {
      stopped_.store(true, std::memory_order_relaxed);
    }
    return stopped_.load(std::memory_order_relaxed);
  }
  bool count_piece() {
    return pieces_.fetch_add(1, std::memory_order_relaxed) < options_.limits.fragments ||
           (stopped_.store(true, std::memory_order_relaxed), false);
  }
  void put(LightResult light, ShadowResult& outcome) {
    if (!put_light(options_, std::move(light), outcome)) stopped_ = true;
  }
  LightResult run_light(std::uint32_t light, double from, double to);
  LightResult run_light(const LightInSpace<Space>& light, LightResult result, double from,
                        double to);
  /// The light cut by the planes of those polygons that have a part in front of its plane, a result
  /// for each piece (1992, "Preprocess").
  void run_pieces(std::uint32_t light, double from, double to, ShadowResult& outcome);
  using Trees = PenumbraAndUmbra<Space>;
  bool has_trees(const LightInSpace<Space>& light) const {
    const MethodId area = options_.method.area;
    return light.has_area() ? area == MethodId::kMerged || area == MethodId::kPieces
                            : options_.method.point == MethodId::kMerged;
  }
  /// Whether classes and shares of a light are all that is wanted, and no trees are.
  bool by_contour(const LightInSpace<Space>& light) const {
    return light.has_area() && options_.method.area == MethodId::kContour;
  }
  /// Whether area lights have their shares by contours, but for receivers that stay open.
  bool makes_contours() const {
    return area_contour::HasPlaneDoubles<Space> && options_.method.area == MethodId::kContour &&
           !options_.output.exact_fractions;
  }
  using Order = InterleavedOrder<Space>;
  bool is_interleaved() const { return options_.method.options.interleaved; }
  /// The order of all parts from everywhere, made when it is first asked for. False if stopped.
  bool order_scene();
  /// The trees if a side that sees the light goes down them, else null. `trees`: may be null.
  const Trees* taken_by(Workspace& workspace, const Trees* trees, std::uint32_t part,
                        Side side) const;
  /// Readies a side that sees the light for cut(). Returns the trees if it goes down them, else
  /// null. `trees`: may be null.
  const Trees* prepare_side(Workspace& workspace, const LightInSpace<Space>& light,
                            const Trees* trees, std::uint32_t part, Side side) const;
  /// Cuts the loop of a side, or a fragment of it, by one light; as LightInSpace::cut. `trees`:
  /// what prepare_side() returned.
  template <class Emit>
  bool cut(Workspace& workspace, const LightInSpace<Space>& light, const Trees* trees,
           PlaneRef receiving, const Loop& piece, const Emit& emit) const;
  /// `trees`: may be null. `filtered`: the sides that went down trees while they grew.
  std::vector<SideResult> run_part(Workspace& workspace, const LightInSpace<Space>& light,
                                   const Trees* trees, const FilteredSides<Vertex>& filtered,
                                   std::uint32_t part);
  /// What the contour tells of a side that was prepared; none: it is to be cut. `whole`: the part's
  /// own loop.
  std::optional<SideResult> contour_side(Workspace& workspace, const LightInSpace<Space>& light,
                                         std::uint32_t part, Side side, const Loop& whole) const;
  /// Puts the fragments of a side at the end of a light's.
  void append(SideFragments& side, LightResult& result) const;
  /// Readies the trees for all sides that see the light and that they take; these sides are told to
  /// `filtered`. False if stopped.
  bool begin_trees(const LightInSpace<Space>& light, Trees& trees, FilteredSides<Vertex>& filtered);
  bool build_trees(const LightInSpace<Space>& light, double from, double to, Trees& trees,
                   WorkCounts& counts);
  /// Grows the trees and filters the sides that they take at the same time (1992, "Algorithm").
  bool interleave(const LightInSpace<Space>& light, double from, double to, Trees& trees,
                  FilteredSides<Vertex>& filtered, LightResult& result);
  /// Whether all volumes were cast; else why not is noted.
  bool is_done(typename Trees::Outcome outcome);
  Trees make_trees(const LightInSpace<Space>& light) {
    return {space_, light, scene_, tree_, run_options_, options_.method.options.caps, rules_};
  }
  void combine(const LightList& lights, double from, double to, ShadowResult& outcome);
  RunOutcome stop_reason() const;

  const PreparedScene& scene_;
  const ShadowOptions& options_;
  RunOptions run_options_;
  Rules rules_;
  LightGeometry light_geometry_;
  SceneSpace scene_space_;
  Space space_;
  CasterTree tree_;
  SolidCasters solids_;
  ShellCasters shells_;
  std::optional<area_contour::LightVolumes> volumes_;  // of the light at hand, by contour
  std::optional<std::vector<BspNode>> order_;          // nodes of a scene BSP of all parts
  std::atomic<std::uint64_t> pieces_ = 0;
  std::atomic<bool> stopped_ = false, no_ieee_ = false;
  StageCounts stages_;
};

template <VolumeSpaceModel Space>
template <class Body>
bool ReceiverRun<Space>::for_each(std::size_t n, double from, double to, const Body& body) {
  if constexpr (TakesPlanes<Space>) space_.share_planes();
  Workspaces workspaces;
  std::mutex mutex;
  std::size_t done = 0;
  const auto one = [&](std::size_t i) {
    if (stopped()) return;
    std::unique_ptr<Workspace>& workspace = workspaces.local();
    if (!workspace) {
      if (!check_fp_environment()) {
        no_ieee_.store(true);
        stopped_.store(true);
        return;
      }
      workspace = std::make_unique<Workspace>(space_.fork(), rules_);
    }
    const std::uint32_t mark = workspace->space.plane_mark();
    body(*workspace, i);
    workspace->space.release_planes(mark);
    if (!options_.control.progress) return;
    const std::lock_guard lock(mutex);
    if ((++done & 15) == 0) {
      options_.control.progress(from +
                                (to - from) * static_cast<double>(done) / static_cast<double>(n));
    }
  };
  if (jobs() != 1) {
    tbb::parallel_for(std::size_t{0}, n, one);
  } else {
    for (std::size_t i = 0; i < n; ++i) one(i);
  }
  for (const std::unique_ptr<Workspace>& workspace : workspaces) {
    stages_ += workspace->space.stage_counts();
  }
  return !stopped_;
}

template <VolumeSpaceModel Space>
const PenumbraAndUmbra<Space>* ReceiverRun<Space>::taken_by(Workspace& workspace,
                                                            const Trees* trees, std::uint32_t part,
                                                            Side side) const {
  if (trees == nullptr ||
      !trees->takes(workspace.space, workspace.record, plane_of_side(scene_.parts[part], side))) {
    return nullptr;
  }
  if (!workspace.trees) {
    workspace.trees =
        std::make_unique<VolumeTreeWorkspace<Space>>(workspace.space, options_.output.merge);
  }
  return trees;
}

template <VolumeSpaceModel Space>
const PenumbraAndUmbra<Space>* ReceiverRun<Space>::prepare_side(Workspace& workspace,
                                                                const LightInSpace<Space>& light,
                                                                const Trees* trees,
                                                                std::uint32_t part,
                                                                Side side) const {
  const Trees* taken = taken_by(workspace, trees, part, side);
  if (taken == nullptr) light.prepare(workspace, part, side);
  return taken;
}

template <VolumeSpaceModel Space>
template <class Emit>
bool ReceiverRun<Space>::cut(Workspace& workspace, const LightInSpace<Space>& light,
                             const Trees* trees, PlaneRef receiving, const Loop& piece,
                             const Emit& emit) const {
  if (trees == nullptr) return light.cut(workspace, piece, emit);
  const auto by_trees = [&](const Loop& loop) {
    return trees->cut(workspace.space, workspace.record, *workspace.trees, loop, receiving, emit);
  };
  return light.has_area() ? by_trees(piece)
                          : light.clip_to_region(workspace, piece, emit, by_trees);
}

template <VolumeSpaceModel Space>
std::vector<SideResult> ReceiverRun<Space>::run_part(Workspace& workspace,
                                                     const LightInSpace<Space>& light,
                                                     const Trees* trees,
                                                     const FilteredSides<Vertex>& filtered,
                                                     std::uint32_t index) {
  const Part& part = scene_.parts[index];
  std::vector<SideResult> sides;
  ShadowReason reason = ShadowReason::kNone;
  FragmentSink<Space> sink(scene_, run_options_, rules_);
  for (const Side side : {Side::kFront, Side::kBack}) {
    if (side == Side::kBack && !part.two_sided) break;
    const Sight sight = light.sight(workspace, index, side);
    if (!sight.sees()) {
      if (reason == ShadowReason::kNone) reason = sight.reason;
      continue;
    }
    const bool is_filtered = filtered.has(index, side);
    const Loop whole = part_loop(workspace.space, scene_, index, workspace.whole);
    if (by_contour(light)) {
      if (auto found = contour_side(workspace, light, index, side, whole)) {
        sides.push_back(*std::move(found));
        continue;
      }
    }
    const Trees* taken = is_filtered ? nullptr : prepare_side(workspace, light, trees, index, side);
    sink.begin(index, side, light.has_area());
    const auto add = [&](const PieceClass& state, const Loop& loop) {
      sink.add(state, loop);
      return count_piece();
    };
    if (is_filtered) {
      filtered.for_each(index, side, part.plane, add);
    } else {
      cut(workspace, light, taken, plane_of_side(part, side), whole, add);
    }
    if (stopped_) return sides;
    sink.collapse(whole);
    sink.name_witnesses([&](std::uint32_t caster, const Loop& piece) {
      const std::uint32_t solid = light.solid_of(caster);
      return solid == SolidCasters::kNone ? std::vector<std::uint32_t>()
                                          : light.faces_hiding(workspace, piece, solid);
    });
    sides.push_back(sink.finish(workspace.space, whole));
    if (by_contour(light)) sides.back().drop_fragments();
  }
  if (sides.empty())
    sides.push_back(
        dark_side(index, Side::kFront, reason, light.has_area(), options_.output.exact_fractions));
  return sides;
}

template <VolumeSpaceModel Space>
std::optional<SideResult> ReceiverRun<Space>::contour_side(Workspace& workspace,
                                                           const LightInSpace<Space>& light,
                                                           std::uint32_t index, Side side,
                                                           const Loop& whole) const {
  std::optional<area_contour::Shares> shares;
  if constexpr (area_contour::HasPlaneDoubles<Space>) {
    if (volumes_) {
      shares = workspace.contour.find(workspace, light, *volumes_, index, side, whole);
    }
  }
  if (!shares) {
    ++workspace.open;
    return std::nullopt;
  }
  SideResult result;
  result.part.part = index;
  result.part.side = side;
  result.part.lit = shares->lit;
  result.area = {shares->penumbra, shares->umbra};
  return result;
}

template <VolumeSpaceModel Space>
void ReceiverRun<Space>::append(SideFragments& side, LightResult& result) const {
  const auto base = static_cast<std::uint32_t>(options_.output.points ? result.points.size()
                                                                      : result.exact_points.size());
  for (Fragment& fragment : side.fragments) {
    fragment.first += base;
    if (fragment.casters != Fragment::kNoCaster) {
      fragment.casters += static_cast<std::uint32_t>(result.caster_sets.size());
    }
    result.fragments.push_back(fragment);
  }
  std::ranges::move(side.caster_sets, std::back_inserter(result.caster_sets));
  result.points.insert(result.points.end(), side.points.begin(), side.points.end());
  std::ranges::move(side.exact_points, std::back_inserter(result.exact_points));
}

template <VolumeSpaceModel Space>
LightResult ReceiverRun<Space>::run_light(std::uint32_t index, double from, double to) {
  pieces_ = 0;
  const std::uint32_t mark = space_.plane_mark();
  const LightInSpace<Space> light(space_, light_geometry_, tree_, index, rules_, solids(), shells(),
                                  jobs());
  stages_ += light.stage_counts();
  LightResult result;
  result.light = index;
  light.count(result.work);
  result = run_light(light, std::move(result), from, to);
  space_.release_planes(mark);
  return result;
}

template <VolumeSpaceModel Space>
void ReceiverRun<Space>::run_pieces(std::uint32_t index, double from, double to,
                                    ShadowResult& outcome) {
  pieces_ = 0;
  const LightFace& face = light_geometry_.faces[index];
  LoopStore<Vertex> whole;
  for (std::size_t i = 0; i < face.loop.size(); ++i) {
    whole.push(space_.input_vertex(face.loop[i]),
               space_.edges().of_edge(face.edges[i].index(), face.edges[i].flipped()));
  }
  // What has no part in front of the light neither casts nor receives (1992, "Preprocess").
  const PlaneRef front(face.plane, face.flipped);
  LoopStore<Vertex> store;
  SplitRecord record;
  const auto is_before_light = [&](std::uint32_t part) {
    if (scene_.parts[part].plane == face.plane) return false;
    const Placement place = record.decide(space_, front, part_loop(space_, scene_, part, store));
    return place == Placement::kFront || place == Placement::kSpanning;
  };
  std::vector<PlaneRef> planes;
  std::vector<bool> known(light_geometry_.geometry.planes.size(), false);
  for (std::uint32_t i = 0; i < scene_.parts.size(); ++i) {
    const Part& part = scene_.parts[i];
    if (known[part.plane] || !is_before_light(i)) continue;
    known[part.plane] = true;
    planes.emplace_back(part.plane, part.flipped);
  }
  LightCut<Vertex> cut;
  if (!cut_light(space_, whole.view({0, whole.size(), 0}, face.plane), planes,
                 options_.limits.fragments, cut)) {
    pieces_ = options_.limits.fragments + 1;
    stopped_ = true;
    return;
  }
  const auto count = static_cast<double>(cut.pieces.size());
  for (std::uint32_t i = 0; i < cut.pieces.size() && !stopped_; ++i) {
    const Loop piece = cut.loops.view(cut.pieces[i], face.plane);
    const std::uint32_t mark = space_.plane_mark();
    const LightInSpace<Space> light(space_, light_geometry_, tree_, index, rules_, piece, jobs());
    stages_ += light.stage_counts();
    LightResult result;
    result.light = index;
    result.piece = i;
    for (std::uint32_t k = 0; k < piece.size(); ++k) {
      result.piece_loop.push_back(space_.exact_position(piece.corner(k)));
    }
    result = run_light(light, std::move(result), from + (to - from) * (i / count),
                       from + (to - from) * ((i + 1) / count));
    if (i == 0) result.dropped_slivers += cut.vanished;
    if (!stopped_) put(std::move(result), outcome);
    space_.release_planes(mark);
  }
}

template <VolumeSpaceModel Space>
LightResult ReceiverRun<Space>::run_light(const LightInSpace<Space>& light, LightResult result,
                                          double from, double to) {
  std::optional<Trees> merged;
  FilteredSides<Vertex> filtered;
  if (has_trees(light)) {
    merged.emplace(make_trees(light));
    const double middle = from + (to - from) / 2;
    const bool done = is_interleaved() ? interleave(light, from, middle, *merged, filtered, result)
                                       : build_trees(light, from, middle, *merged, result.work);
    if (!done) return result;
    from = middle;
  }
  if constexpr (area_contour::HasPlaneDoubles<Space>) {
    if (makes_contours() && light.has_area()) {
      volumes_.emplace(area_contour::light_volumes(space_, light_geometry_, tree_, light, jobs()));
    }
  }
  std::vector<std::vector<SideResult>> parts(scene_.parts.size());
  // The largest first: their work may be most of all, and what is started last is waited for.
  std::vector<std::uint32_t> order(scene_.parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<double> size(order.size());
  for (std::uint32_t i = 0; i < size.size(); ++i) {
    const Box& box = tree_.box(i);
    for (std::size_t k = 0; k < 3; ++k) size[i] += box.high[k] - box.low[k];
  }
  const auto largest_first = [&](std::uint32_t i) { return std::pair(-size[i], i); };
  if (by_contour(light)) {
    const std::size_t few = std::min(order.size(), area_contour::kLargestFirst);
    std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(few), {},
                              largest_first);
    area_contour::sort_by_space(tree_, std::span(order).subspan(few), jobs());
  } else {
    std::ranges::sort(order, {}, largest_first);
  }
  std::atomic<std::uint64_t> cells = 0, vanished = 0, open = 0;
  for_each(order.size(), from, to, [&](Workspace& workspace, std::size_t i) {
    const std::uint64_t cells_before = workspace.cutter.cells(),
                        vanished_before = workspace.cutter.vanished();
    const std::uint64_t filtered_before = workspace.trees ? workspace.trees->filter.vanished() : 0;
    const std::uint64_t open_before = workspace.open;
    parts[order[i]] = run_part(workspace, light, merged ? &*merged : nullptr, filtered, order[i]);
    if (workspace.trees) vanished += workspace.trees->filter.vanished() - filtered_before;
    cells += workspace.cutter.cells() - cells_before;
    vanished += workspace.cutter.vanished() - vanished_before;
    open += workspace.open - open_before;
  });
  volumes_.reset();
  if (by_contour(light)) result.work[Counter::kOpenPolygons] = open;
  result.tree_nodes = cells + (merged ? merged->node_count() : 0);
  result.dropped_slivers += vanished + (merged ? merged->findings() : 0);
  if (stopped_) return result;
  for (std::vector<SideResult>& sides : parts) {
    for (SideResult& side : sides) {
      if (side.part.reason == ShadowReason::kNone) {
        ++result.facing_parts;
        result.facing_edges += scene_.parts[side.part.part].count;
      }
      side.part.first_fragment = static_cast<std::uint32_t>(result.fragments.size());
      if (side.cut) append(*side.cut, result);
      result.parts.push_back(side.part);
      if (light.has_area()) result.area_fractions.push_back(side.area);
      if (side.exact) result.exact_fractions.push_back(*std::move(side.exact));
    }
    std::vector<SideResult>().swap(sides);  // frees what {} would keep
  }
  result.fragment_total = result.fragments.size();
  return result;
}

/// Every fragment of one light goes on to the next (1989, sec. 5), where it is cut by the volumes
/// that reach its side, or goes down that light's trees (1992).
template <VolumeSpaceModel Space>
void ReceiverRun<Space>::combine(const LightList& indices, double from, double to,
                                 ShadowResult& outcome) {
  struct Combined {
    std::vector<CombinedFragment> fragments;
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<mpq_class, 3>> exact_points;
    bool is_behind = false;  // of an area light, and seen by none
  };
  struct Piece {
    LoopRange loop;
    std::uint64_t lit_by = 0, penumbra_of = 0;
  };
  pieces_ = 0;
  const std::uint32_t mark = space_.plane_mark();
  std::deque<LightInSpace<Space>> lights;
  std::deque<std::optional<Trees>> trees;
  for (const std::uint32_t light : indices) {
    lights.emplace_back(space_, light_geometry_, tree_, light, rules_, solids(), nullptr, jobs());
    stages_ += lights.back().stage_counts();
    trees.emplace_back();
  }
  if (std::ranges::any_of(lights, [&](const auto& light) { return has_trees(light); })) {
    const double middle = from + (to - from) / 2;
    const double step = (middle - from) / static_cast<double>(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
      if (!has_trees(lights[i])) continue;
      trees[i].emplace(make_trees(lights[i]));
      const double begin = from + step * static_cast<double>(i);
      WorkCounts counts;  // those of the light alone are told
      if (!build_trees(lights[i], begin, begin + step, *trees[i], counts)) return;
    }
    from = middle;
  }
  std::vector<std::array<Combined, 2>> results(scene_.parts.size());
  const auto run_side = [&](Workspace& workspace, std::uint32_t part, Side side, Combined& out) {
    const PlaneId plane = scene_.parts[part].plane;
    LoopStore<Vertex> now, next;
    std::vector<Piece> pieces, fragments;
    bool seen = false;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const Sight sight = lights[i].sight(workspace, part, side);
      out.is_behind = out.is_behind || sight.reason == ShadowReason::kBehindLight;
      if (!sight.sees()) continue;
      if (!seen) {
        pieces.push_back(
            {now.append(part_loop(workspace.space, scene_, part, workspace.whole)), 0, 0});
        seen = true;
      }
      const Trees* taken =
          prepare_side(workspace, lights[i], trees[i] ? &*trees[i] : nullptr, part, side);
      next.clear();
      fragments.clear();
      for (const Piece& piece : pieces) {
        const bool done =
            cut(workspace, lights[i], taken, plane_of_side(scene_.parts[part], side),
                now.view(piece.loop, plane), [&](const PieceClass& state, const Loop& loop) {
                  Piece fragment{next.append(loop), piece.lit_by, piece.penumbra_of};
                  const std::uint64_t bit = std::uint64_t{1} << i;
                  if (state.state == LightState::kLit) fragment.lit_by |= bit;
                  if (state.state == LightState::kPenumbra) fragment.penumbra_of |= bit;
                  fragments.push_back(fragment);
                  return count_piece();
                });
        if (!done) return;
      }
      std::swap(now, next);
      std::swap(pieces, fragments);
    }
    out.is_behind = out.is_behind && !seen;
    if (out.is_behind) {
      pieces.push_back({now.append(part_loop(workspace.space, scene_, part, workspace.whole))});
    }
    for (const Piece& piece : pieces) {
      CombinedFragment fragment{part, side, piece.lit_by, piece.penumbra_of};
      export_volume_loop(workspace.space, run_options_, now.view(piece.loop, plane),
                         side == Side::kBack, fragment, out.points, out.exact_points);
      out.fragments.push_back(fragment);
    }
  };
  for_each(scene_.parts.size(), from, to, [&](Workspace& workspace, std::size_t i) {
    const auto part = static_cast<std::uint32_t>(i);
    run_side(workspace, part, Side::kFront, results[i][0]);
    if (scene_.parts[i].two_sided) run_side(workspace, part, Side::kBack, results[i][1]);
  });
  space_.release_planes(mark);
  if (stopped_) return;
  // Grouped by polygon and side: parts of a polygon are neighbours.
  for (std::size_t polygon = 0; polygon + 1 < scene_.first_part.size(); ++polygon) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t begin = scene_.first_part[polygon], end = scene_.first_part[polygon + 1];
      // What is behind a light is told where other parts of the side are seen, as fragments tile
      // it.
      bool is_seen = false;
      for (std::uint32_t part = begin; part < end; ++part) {
        const Combined& own = results[part][side];
        is_seen = is_seen || (!own.fragments.empty() && !own.is_behind);
      }
      for (std::uint32_t part = begin; is_seen && part < end; ++part) {
        Combined& own = results[part][side];
        const auto base = static_cast<std::uint32_t>(options_.output.points
                                                         ? outcome.combined_points.size()
                                                         : outcome.combined_exact_points.size());
        for (CombinedFragment& fragment : own.fragments) {
          fragment.first += base;
          outcome.combined.push_back(fragment);
        }
        outcome.combined_points.insert(outcome.combined_points.end(), own.points.begin(),
                                       own.points.end());
        std::move(own.exact_points.begin(), own.exact_points.end(),
                  std::back_inserter(outcome.combined_exact_points));
      }
    }
  }
}

template <VolumeSpaceModel Space>
RunOutcome ReceiverRun<Space>::stop_reason() const {
  if (no_ieee_) return RunOutcome::kNoIeee;
  return pieces_ > options_.limits.fragments ? RunOutcome::kTooManyFragments
                                             : RunOutcome::kInterrupted;
}

template <VolumeSpaceModel Space>
Expected<ShadowResult> ReceiverRun<Space>::run(const LightList& lights, const LightList& combined) {
  ShadowResult outcome = empty_result(options_);
  const double steps = static_cast<double>(lights.size() + (combined.empty() ? 0 : 1));
  double step = 0;
  for (const std::uint32_t light : lights) {
    if (options_.method.area == MethodId::kPieces && scene_.lights[light].has_area()) {
      run_pieces(light, step / steps, (step + 1) / steps, outcome);
    } else {
      LightResult result = run_light(light, step / steps, (step + 1) / steps);
      if (!stopped_) put(std::move(result), outcome);
    }
    if (stopped_) return stopped_by(stop_reason(), options_);
    ++step;
  }
  if (!combined.empty()) {
    combine(combined, step / steps, 1, outcome);
    if (stopped_) return stopped_by(stop_reason(), options_);
  }
  outcome.stages += stages_;
  outcome.stages += space_.stage_counts();
  outcome.stages += scene_space_.stage_counts();
  return outcome;
}

/// On as many threads as asked for.
template <class Kernel>
Expected<ShadowResult> ByReceiver<Kernel>::run(const RunTask& task) {
  tbb::task_arena arena(thread_count(task.options.tuning.jobs));
  return arena.execute([&] {
    return with_volume_space<Kernel>(task.options.output.stage_counts, [&]<class Space>() {
      return ReceiverRun<Space>(task.scene, task.options, task.rules)
          .run(task.lights, task.combined);
    });
  });
}

}  // namespace gnomon

#include "algorithms/run/receiver_trees.inl.h"

#endif  // GNOMON_ALGORITHMS_RUN_RECEIVER_RUN_H
